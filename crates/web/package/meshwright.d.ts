/** An error or a warning about a recipe. */
export interface Problem {
    severity: "error" | "warning";
    /** The path of the file that the problem is in. */
    file: string | null;
    /** The line, counted from 1. */
    line: number | null;
    /** The column in characters, counted from 1. */
    column: number | null;
    message: string;
    /** How to correct the text. */
    help: string | null;
    /**
     * The start and the exclusive end in the text of the recipe, in UTF-16 code units. `null` if the problem is
     * elsewhere.
     */
    range: [number, number] | null;
}

/** A step that is done. The counts are totals of all meshes after the step. */
export interface StepDone {
    event: "done";
    /** The number of the step, counted from 1. */
    number: number;
    label: string;
    vertices: number;
    edges: number;
    faces: number;
    /** The number of elements or objects that the step changed or created. */
    changed: number;
    /** Edits that were refused and skipped, by reason. */
    refused: { reason: string; count: number; first: string }[];
    losses: { object: string | null; name: string; message: string }[];
    changes: { code: string; count: number; text: string; vertices?: number[]; edges?: number[]; faces?: number[] }[];
    notes: string[];
    milliseconds: number;
    /** Whether the result is from an earlier run of the session, so that the step did not run. */
    cached: boolean;
}

export type Event =
    | { event: "step"; number: number; label: string; operation: string }
    | { event: "progress"; what: string; done: number; total: number }
    | StepDone;

/** The result of a check. */
export interface Checked {
    problems: Problem[];
    /** The parameters. `min` and `max` are the limits of a number, `of` has the allowed names of a `Choice`. */
    parameters: {
        name: string;
        type: "Int" | "Float" | "Bool" | "Text" | "Path" | "Choice" | "Vector";
        value: string;
        doc: string | null;
        min: number | null;
        max: number | null;
        of: string[] | null;
    }[];
    /** The names of the presets. */
    presets: string[];
    /** The steps in order. `line` is the line in the recipe, counted from 1; `null` if the step is in a called recipe. */
    steps: { label: string; operation: string; line: number | null }[];
    /** An upper bound of the memory of all meshes together after any step, in bytes. `null` if unknown. */
    peak_bytes: number | null;
}

/** The result of a run. */
export interface Result {
    succeeded: boolean;
    cancelled: boolean;
    problems: Problem[];
    steps: StepDone[];
    /** The expectations that were checked. `text` is the expectation as written. */
    expectations: { file: string; line: number; text: string; met: boolean }[];
    /** The digest of the scene at the end: 32 hexadecimal digits. `null` if the recipe has errors. */
    digest: string | null;
    /** The paths of the written files, in the folder `out`. */
    files: string[];
    objects: { name: string; kind: string; vertices?: number; edges?: number; faces?: number }[];
}

/** The arrays of a mesh. Vertices and faces have the numbers that recipes use. */
export interface MeshArrays {
    /** The center of the bounding box, in scene units. */
    center: Float64Array;
    /** The position of each vertex relative to the center: x, y and z, one vertex after another. */
    positions: Float32Array;
    /** The three vertices of each triangle. A polygon has several triangles. */
    triangles: Uint32Array;
    /** The face of each triangle. */
    faces: Uint32Array;
    /** The two vertices of each edge. */
    edges: Uint32Array;
}

/** A quantity as recipes write it in `ColorBy(of: ..)`, such as `"MeanCurvature"`. */
export type Quantity = string | Record<string, unknown>;

/** The colors of all meshes that have a quantity, with a common scale. Colors of the legend are texts such as `#4477aa`. */
export interface Colors {
    legend:
        | { title: string; low: number; high: number; colors: string[] }
        | { title: string; classes: [name: string, color: string][] };
    meshes: {
        /** The name of the object. */
        name: string;
        /**
         * The elements that have colors: the vertices, the corners of the triangles in the order of `triangles`, or the
         * edges.
         */
        per: "vertex" | "corner" | "edge";
        /** Red, green and blue in sRGB of each element, one element after another. */
        colors: Uint8Array;
    }[];
}

export interface Options {
    /** The path of the recipe. Paths in the recipe are relative to its folder. Defaults to `recipe.ron`. */
    path?: string;
    /** The name of one of the presets of the recipe. */
    preset?: string;
    /** Values of parameters. They take precedence over the preset. */
    set?: Record<string, string | number | boolean>;
}

export interface RunOptions extends Options {
    /**
     * Receives the events of the run. If the function returns false for a `progress` event, the run is canceled.
     * Progress is reported at most ten times per second.
     */
    onEvent?: (event: Event) => boolean | void;
}

/** Loads the engine once. `source` is the WebAssembly file. Defaults to the file beside this module. */
export function load(source?: URL | Response | BufferSource | WebAssembly.Module): Promise<void>;

/** Files in memory, and the scene of the last run. */
export class Session {
    /** Loads the engine and creates a session without files. */
    static create(source?: Parameters<typeof load>[0]): Promise<Session>;
    /** Creates a session without files. The engine must be loaded. */
    constructor();
    /**
     * Writes a file, which recipes can then read. Missing folders of the path are created. Throws if the path is the path
     * of a folder, or if a part of the path is a file.
     */
    write(path: string, content: string | Uint8Array): void;
    /** Reads a file, such as an output of a run. Throws if the file does not exist. */
    read(path: string): Uint8Array;
    /** Removes a file or a folder with its files, if it exists. */
    remove(path: string): void;
    /** Checks a recipe without running it. */
    check(recipe: string, options?: Options): Checked;
    /**
     * Checks and runs a recipe. The run usually starts at the first step that has changed since the previous run. A
     * step that writes a file counts as changed. If a file was written or removed after the previous run, all steps
     * run. Blocks until the run ends, so a page should call this method in a worker. Throws `RuntimeError` if memory is
     * exhausted. The engine cannot be used afterwards, so the page must then start a new worker.
     */
    run(recipe: string, options?: RunOptions): Result;
    /**
     * Renders the scene of the last run as a PNG file. `up` is the axis that points upwards. Defaults to `auto`: z if
     * the scene stands on the plane z = 0 and not on y = 0, otherwise y. Throws if the picture is too large.
     */
    picture(options?: { width?: number; height?: number; wireframe?: boolean; up?: "auto" | "y" | "z" }): Uint8Array;
    /** Returns the arrays of a mesh of the last run; `undefined` if no mesh has this name. */
    mesh(object: string): MeshArrays | undefined;
    /**
     * Returns the placement of each instance of a mesh of the last run. A placement is the matrix that maps the mesh to
     * the scene, as 16 numbers, column by column. A skinned mesh has the placement of its first joint.
     */
    placements(object: string): Float64Array;
    /** Returns the quantities of the meshes of the last run that `colors` can show. */
    quantities(): { title: string; quantity: Quantity }[];
    /** Returns a quantity of the meshes of the last run as colors. Throws if no mesh has the quantity. */
    colors(quantity: Quantity): Colors;
    /** Returns the JSON schema of recipes. */
    schema(): object;
    /** Returns all operations, each with an example of a step. */
    operations(): { name: string; summary: string; example: string }[];
    /** Releases the memory of the session. */
    free(): void;
}

/**
 * Checks and runs a recipe. `files` has the content of each file by its path. The result also has the content of each
 * written file by its path in the output folder, and the arrays of each mesh by its name.
 */
export function run(
    recipe: string,
    files?: Record<string, string | Uint8Array>,
    options?: RunOptions,
): Promise<Result & { outputs: Record<string, Uint8Array>; meshes: Record<string, MeshArrays> }>;
