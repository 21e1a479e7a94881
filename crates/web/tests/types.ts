// A sample that uses the types of the package. This file is checked by `tsc`, but not run.
import { load, run, Session, type Checked, type Event, type Problem, type Result } from "meshwright";

const recipe = "(recipe: 1, steps: [Cube(name: \"a\")])";
await load(new URL("core_bg.wasm", "https://example.com/"));

const result = await run(recipe, { "a.obj": "v 0 0 0\n", "b.stl": new Uint8Array(84) }, {
    preset: "fine",
    set: { levels: 3, closed: true, axis: "Y" },
    onEvent: (event: Event) => event.event !== "progress" || event.done < event.total,
});
const output: Uint8Array | undefined = result.outputs["a.obj"];
const triangles: Uint32Array | undefined = result.meshes.a?.triangles;
const cached: boolean[] = result.steps.map((step) => step.cached);

const session = await Session.create();
const checked: Checked = session.check(recipe, { path: "recipes/a.ron" });
const problems: Problem[] = checked.problems;
const again: Result = session.run(recipe);
const picture: Uint8Array = session.picture({ width: 320, height: 240, up: "z" });
for (const { quantity } of session.quantities()) {
    const { legend, meshes } = session.colors(quantity);
    const title: string = "classes" in legend ? legend.classes.join() : legend.title + legend.low;
    const colors: Uint8Array[] = meshes.map((mesh) => mesh.colors);
    console.log(title, colors);
}
session.write("a.obj", "v 0 0 0\n");
session.remove("a.obj");
session.free();
console.log(output, triangles, cached, problems, again, picture);

// @ts-expect-error A preset is a name.
await run(recipe, {}, { preset: 1 });
// @ts-expect-error A file is a string or bytes.
session.write("a.obj", 1);
