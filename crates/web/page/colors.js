// Meshes colored by a quantity, and the legend.
import * as THREE from "three";
import { byId, element } from "./dom.js";

/// The linear light of each sRGB value, from 0 to 65535 (IEC 61966-2-1, 1999).
const LIGHT = Uint16Array.from({ length: 256 }, (_, i) => {
    const s = i / 255;
    return Math.round(65535 * (s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4));
});

/// Colors a group, which consists of a surface and its lines. `found` has the colors: `{ per: "vertex" | "corner" |
/// "edge", colors }`. Without `found`, the surface gets its own color again.
export function paint(group, found) {
    const [surface, lines] = group.children;
    const plain = (group.userData.plain ??= { surface: surface.geometry, color: surface.material.color.clone(), lines: lines.geometry,
        line: lines.material.color.clone(), opacity: lines.material.opacity });
    for (const [drawn, own] of [[surface, plain.surface], [lines, plain.lines]]) {
        if (drawn.geometry !== own) {
            drawn.geometry.dispose();
            drawn.geometry = own;
        }
    }
    plain.surface.deleteAttribute("color");
    const per = found?.per;
    surface.material.vertexColors = per === "vertex" || per === "corner";
    surface.material.color.copy(plain.color);
    lines.material.vertexColors = per === "edge";
    lines.material.color.copy(plain.line);
    lines.material.opacity = per === "edge" ? 1 : plain.opacity;
    lines.material.needsUpdate = true;
    if (per === "edge") {
        // Both ends of an edge get the color of the edge.
        lines.geometry = plain.lines.toNonIndexed();
        lines.geometry.setAttribute("color", attribute(found.colors, 2));
        lines.material.color.set(0xffffff);
        surface.material.color.setScalar(0.75);
    } else if (per) {
        if (per === "corner") {
            // The corners of a vertex can have different colors, but they share the normal of the vertex.
            plain.surface.computeVertexNormals();
            surface.geometry = plain.surface.toNonIndexed();
        }
        surface.geometry.setAttribute("color", attribute(found.colors, 1));
        surface.material.color.set(0xffffff);
    }
}

/// Converts sRGB colors to an attribute. Each color is repeated `times` times.
function attribute(colors, times) {
    const light = new Uint16Array(times * colors.length);
    for (let i = 0; i < light.length; i += 1) {
        light[i] = LIGHT[colors[3 * Math.floor(i / (3 * times)) + (i % 3)]];
    }
    return new THREE.BufferAttribute(light, 3, true);
}

/// Shows the legend of a quantity: `{ title, low, high, colors }` or `{ title, classes }`. Without `legend`, hides the
/// legend.
export function showLegend(legend) {
    byId("legend").hidden = !legend;
    if (!legend) {
        return;
    }
    const { title, low, high, colors, classes } = legend;
    const swatch = (background) => {
        const created = element("span", { class: "swatch" });
        created.style.background = background;
        return created;
    };
    const number = (x) => String(Number(x.toPrecision(4)));
    const parts = colors ? [number(low), swatch(`linear-gradient(to right, ${colors.join(", ")})`), number(high)]
        : classes.slice(0, 12).map(([name, color]) => element("span", {}, swatch(color), ` ${name}`));
    const more = (classes?.length ?? 0) - 12;
    byId("legend").classList.toggle("range", Boolean(colors));
    byId("legend").replaceChildren(element("span", {}, title), ...parts, ...more > 0 ? [`and ${more} more`] : []);
}
