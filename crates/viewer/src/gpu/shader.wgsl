// Draws surfaces, lines and dots. The lights and materials are those of the crate `render`, so that the window and the
// operation `Picture` look alike.

struct Globals {
    projection: mat4x4f,
    rotation: mat4x4f,
    // The width and height of the picture in pixels, the distance from the camera to the target, and the number of
    // pixels per scene unit. With perspective, this number is for distance 1 from the camera.
    size: vec4f,
    // x: the lighting. 0 is flat or smooth, 1 Phong, 2 clay, and 3 plain.
    // y: the lines. 0 is none, 1 on the surface, 2 hidden lines removed, and 3 lines only.
    // z: whether the projection has perspective.
    // w: whether the normals of the mesh are used.
    modes: vec4u,
    wire: vec4f,
    // The width of the wireframe in pixels.
    widths: vec4f,
    background: vec4f,
    background_top: vec4f,
}

struct Object {
    // The center of the object, relative to the target of the camera.
    offset: vec4f,
    color: vec4f,
    // The color of the back, if w is 1.
    back: vec4f,
    // x: where the normals are stored. 0 is one for all, 1 one per triangle, 2 one per point, and 3 one per corner.
    // y: where the colors are stored, in the same way.
    // z: whether the surface is shown without lighting.
    // w: whether the surface has a texture.
    modes: vec4u,
    emissive: vec3f,
    roughness: f32,
}

@group(0) @binding(0) var<uniform> globals: Globals;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<storage, read> points: array<f32>;
@group(2) @binding(1) var<storage, read> triangles: array<u32>;
@group(2) @binding(2) var<storage, read> normals: array<u32>;
@group(2) @binding(3) var<storage, read> colors: array<u32>;
@group(2) @binding(4) var<storage, read> uvs: array<vec2f>;
@group(2) @binding(5) var image: texture_2d<f32>;
@group(2) @binding(6) var image_sampler: sampler;

// If the value of a normal is this constant, the shader uses the normal of the triangle instead.
const NO_NORMAL: u32 = 0x80008000u;

fn to_linear(c: vec3f) -> vec3f {
    return select(pow((c + 0.055) / 1.055, vec3f(2.4)), c / 12.92, c <= vec3f(0.04045));
}

// Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", 2014.
fn decode_normal(word: u32) -> vec3f {
    let e = unpack2x16snorm(word);
    var n = vec3f(e, 1.0 - abs(e.x) - abs(e.y));
    if n.z < 0.0 {
        let folded = (1.0 - abs(n.yx)) * select(vec2f(-1.0), vec2f(1.0), n.xy >= vec2f(0.0));
        n = vec3f(folded, n.z);
    }
    return normalize(n);
}

fn to_camera(p: vec3f) -> vec3f {
    var v = (globals.rotation * vec4f(p + object.offset.xyz, 1.0)).xyz;
    v.z -= globals.size.z;
    return v;
}

fn place(mode: u32, i: u32, point: u32) -> u32 {
    return select(select(select(i, point, mode == 2u), i / 3u, mode == 1u), 0u, mode == 0u);
}

struct Surface {
    @builtin(position) position: vec4f,
    @location(0) at: vec3f,
    @location(1) normal: vec3f,
    @location(2) color: vec3f,
    @location(3) weights: vec3f,
    @location(4) @interpolate(flat) flags: u32,
    // At the border of a triangle, the position in the image is computed at a point inside the triangle. Otherwise, the
    // pixel could show another part of the image.
    @location(5) @interpolate(perspective, centroid) uv: vec2f,
}

@vertex
fn surface_vertex(@builtin(vertex_index) i: u32) -> Surface {
    let first = i - i % 3u;
    let word = triangles[i];
    let point = word & 0x7fffffffu;
    var out: Surface;
    out.at = to_camera(vec3f(points[3u * point], points[3u * point + 1u], points[3u * point + 2u]));
    out.position = globals.projection * vec4f(out.at, 1.0);
    // Bit j (0, 1 or 2) says whether the side opposite corner j is an edge of the mesh. Bit 3 says whether the corner
    // has a normal.
    let bits = vec3u(triangles[first], triangles[first + 1u], triangles[first + 2u]) >> vec3u(31u);
    out.flags = bits.y | (bits.z << 1u) | (bits.x << 2u);
    out.weights = vec3f(f32(i % 3u == 0u), f32(i % 3u == 1u), f32(i % 3u == 2u));
    out.normal = vec3f(0.0);
    if globals.modes.w == 1u {
        let n = normals[place(object.modes.x, i, point)];
        if n != NO_NORMAL {
            out.normal = (globals.rotation * vec4f(decode_normal(n), 0.0)).xyz;
            out.flags |= 8u;
        }
    }
    out.color = object.color.rgb;
    if object.modes.y != 0u {
        out.color *= to_linear(unpack4x8unorm(colors[place(object.modes.y, i, point)]).rgb);
    }
    if object.modes.w != 0u {
        out.uv = uvs[i];
    }
    return out;
}

const KEY: vec3f = vec3f(-0.45, 0.65, 0.75);
const FILL: vec3f = vec3f(0.8, -0.05, 0.45);
const KEY_LIGHT: vec3f = vec3f(0.84, 0.82, 0.78);
const FILL_LIGHT: vec3f = vec3f(0.09, 0.10, 0.115);
const SKY: vec3f = vec3f(0.42, 0.435, 0.46);
const GROUND: vec3f = vec3f(0.17, 0.16, 0.15);

fn lit(color: vec3f, n: vec3f, to_eye: vec3f) -> vec3f {
    if globals.modes.x == 2u {
        let wrapped = dot(n, normalize(KEY)) * 0.5 + 0.5;
        let broad = 0.16 + 0.84 * wrapped * wrapped;
        let border = pow(1.0 - clamp(n.z, 0.0, 1.0), 3.0) * 0.35;
        let high = pow(max(dot(n, normalize(vec3f(-0.28, 0.42, 0.86))), 0.0), 30.0) * 0.16;
        return color * broad + border * (0.35 + 0.65 * color) + high;
    }
    let key = max(dot(n, normalize(KEY)), 0.0);
    let fill = max(dot(n, normalize(FILL)), 0.0);
    let sky = mix(GROUND, SKY, 0.5 + 0.5 * n.y);
    var light = color * (sky + KEY_LIGHT * key + FILL_LIGHT * fill);
    if globals.modes.x == 1u {
        // Blinn, "Models of Light Reflection for Computer Synthesized Pictures", 1977.
        let half_way = normalize(normalize(KEY) + to_eye);
        let exponent = 40.0 + 200.0 * (1.0 - object.roughness);
        light += pow(max(dot(n, half_way), 0.0), exponent) * (0.45 + 0.4 * (1.0 - object.roughness));
    }
    return light;
}

// Returns the opacity of the wireframe. Lines that are only a few pixels apart are thinner, so that they do not cover
// the surface.
fn wire(weights: vec3f, flags: u32) -> f32 {
    let gradient = sqrt(dpdx(weights) * dpdx(weights) + dpdy(weights) * dpdy(weights));
    let spacing = 1.0 / max(gradient, vec3f(1e-6));
    let distance = weights * spacing;
    let half_width = min(vec3f(0.5 * globals.widths.x), 0.12 * spacing);
    // A line that is thinner than a pixel is drawn one pixel wide, but fainter.
    let strength = clamp(2.0 * half_width, vec3f(0.0), vec3f(1.0));
    let cover = clamp(max(half_width, vec3f(0.5)) + 0.5 - distance, vec3f(0.0), vec3f(1.0)) * strength;
    let is_edge = vec3f((vec3u(flags) >> vec3u(0u, 1u, 2u)) & vec3u(1u));
    let all = cover * is_edge;
    return max(all.x, max(all.y, all.z));
}

@fragment
fn surface_fragment(in: Surface, @builtin(front_facing) is_front: bool) -> @location(0) vec4f {
    // The derivatives are computed first, because WGSL does not allow derivatives after a branch that differs between
    // pixels.
    let flat_normal = cross(dpdx(in.at), dpdy(in.at));
    let line = wire(in.weights, in.flags);
    var texel = vec4f(1.0);
    if object.modes.w != 0u {
        texel = textureSample(image, image_sampler, in.uv);
    }
    var to_eye = vec3f(0.0, 0.0, 1.0);
    if globals.modes.z == 1u {
        to_eye = normalize(-in.at);
    }
    var n = normalize(flat_normal + vec3f(0.0, 0.0, 1e-30));
    if dot(n, to_eye) < 0.0 {
        n = -n;
    }
    let length_squared = dot(in.normal, in.normal);
    if (in.flags & 8u) != 0u && length_squared > 1e-12 {
        var m = in.normal * inverseSqrt(length_squared);
        if !is_front {
            m = -m;
        }
        // An interpolated normal can point away from the camera although the triangle faces the camera.
        let facing = dot(m, to_eye);
        if facing < 0.0 {
            m = normalize(m - to_eye * facing + n * 1e-4);
        }
        n = m;
    }
    // The colors of the image are premultiplied by alpha. The division by alpha gives the original colors.
    var color = in.color * texel.rgb / max(texel.a, 0.001);
    var alpha = object.color.a * texel.a;
    if !is_front && object.back.w == 1.0 {
        color = object.back.rgb;
    }
    if globals.modes.x != 3u && object.modes.z == 0u {
        color = lit(color, n, to_eye);
    }
    color += object.emissive;
    let opacity = line * globals.wire.a;
    if globals.modes.y == 1u {
        color = mix(color, globals.wire.rgb, opacity);
        alpha = max(alpha, opacity);
    } else if globals.modes.y == 2u {
        let t = in.position.y / globals.size.y;
        color = mix(mix(globals.background_top.rgb, globals.background.rgb, t), globals.wire.rgb, opacity);
        alpha = 1.0;
    } else if globals.modes.y == 3u {
        return vec4f(globals.wire.rgb, opacity);
    }
    return vec4f(color, alpha);
}

struct Background {
    @builtin(position) position: vec4f,
    @location(0) t: f32,
}

@vertex
fn background_vertex(@builtin(vertex_index) i: u32) -> Background {
    let x = f32(i32(i & 1u) * 4 - 1);
    let y = f32(i32(i >> 1u) * 4 - 1);
    return Background(vec4f(x, y, 1.0, 1.0), 0.5 - 0.5 * y);
}

@fragment
fn background_fragment(in: Background) -> @location(0) vec4f {
    return vec4f(mix(globals.background_top.rgb, globals.background.rgb, in.t), 1.0);
}

// Moves a point in camera space towards the camera, by the length that this many pixels have in the scene. The point
// stays at the same place in the picture.
fn nearer(v: vec3f, pixels: f32) -> vec3f {
    if globals.modes.z == 1u {
        return v * (1.0 - pixels / globals.size.w);
    }
    return v + vec3f(0.0, 0.0, pixels / globals.size.w);
}

struct Line {
    @builtin(position) position: vec4f,
    // The position along the line and across it, the length of the line, and half of its width, in pixels.
    @location(0) along: vec4f,
    @location(1) color: vec4f,
    @location(2) @interpolate(flat) hidden: f32,
}

fn line(i: u32, a: vec3f, b: vec3f, look: vec4f, color: vec4f) -> Line {
    var out: Line;
    out.color = vec4f(to_linear(color.rgb), color.a);
    out.hidden = look.y;
    var p = to_camera(a);
    var q = to_camera(b);
    if globals.modes.z == 1u {
        let near = -2e-3 * globals.size.z;
        if p.z > near && q.z > near {
            out.position = vec4f(2.0, 2.0, 2.0, 1.0);
            return out;
        }
        if p.z > near {
            p = mix(p, q, (near - p.z) / (q.z - p.z));
        }
        if q.z > near {
            q = mix(q, p, (near - q.z) / (p.z - q.z));
        }
    }
    let shift = 3.0 + look.z;
    let p_clip = globals.projection * vec4f(nearer(p, shift), 1.0);
    let q_clip = globals.projection * vec4f(nearer(q, shift), 1.0);
    let scale = 0.5 * globals.size.xy;
    let p_pixel = p_clip.xy / p_clip.w * scale;
    let q_pixel = q_clip.xy / q_clip.w * scale;
    let span = q_pixel - p_pixel;
    let len = length(span);
    var direction = vec2f(1.0, 0.0);
    if len > 1e-3 {
        direction = span / len;
    }
    let half_width = 0.5 * look.x;
    let reach = half_width + 1.0;
    let is_end = (i & 1u) == 1u;
    let side = select(-1.0, 1.0, i >= 2u);
    let t = select(-reach, len + reach, is_end);
    let pixel = p_pixel + direction * t + vec2f(-direction.y, direction.x) * side * reach;
    let z = select(p_clip.z / p_clip.w, q_clip.z / q_clip.w, is_end);
    // With w = 1, all values are interpolated linearly in the picture.
    out.position = vec4f(pixel / scale, z, 1.0);
    out.along = vec4f(t, side * reach, len, half_width);
    return out;
}

@vertex
fn line_vertex(
    @builtin(vertex_index) i: u32,
    @location(0) a: vec3f,
    @location(1) b: vec3f,
    @location(2) look: vec4f,
    @location(3) color: vec4f,
) -> Line {
    return line(i, a, b, look, color);
}

fn from_line(in: Line) -> f32 {
    let beyond = max(max(-in.along.x, in.along.x - in.along.z), 0.0);
    return length(vec2f(beyond, in.along.y));
}

@fragment
fn line_fragment(in: Line) -> @location(0) vec4f {
    let cover = clamp(in.along.w + 0.5 - from_line(in), 0.0, 1.0) * min(2.0 * in.along.w, 1.0);
    return vec4f(in.color.rgb, in.color.a * cover);
}

@fragment
fn hidden_fragment(in: Line) -> @location(0) vec4f {
    var cover = clamp(in.along.w + 0.5 - from_line(in), 0.0, 1.0);
    if in.along.z < 1e-3 {
        // A hidden dot is a ring.
        cover = clamp(1.5 - abs(from_line(in) - in.along.w + 1.0), 0.0, 1.0);
    }
    return vec4f(in.color.rgb, in.color.a * cover * in.hidden);
}

struct Patch {
    @builtin(position) position: vec4f,
    @location(0) color: vec4f,
}

@vertex
fn patch_vertex(@location(0) p: vec3f, @location(1) color: vec4f) -> Patch {
    let v = nearer(to_camera(p), 1.5);
    return Patch(globals.projection * vec4f(v, 1.0), vec4f(to_linear(color.rgb), color.a));
}

@fragment
fn patch_fragment(in: Patch) -> @location(0) vec4f {
    return in.color;
}
