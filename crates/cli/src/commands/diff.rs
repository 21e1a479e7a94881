//! `meshwright diff`: compares two files, or the results of two recipes.

use engine::{Engine, Stop};
use geometry::distance::{Distance, OneSided, SurfacePoint};
use recipe::compare::{
    AttributeDifference, ColumnDifference, Connectivity, Counts, Difference, MeshDifference, Moved,
    ObjectDifference,
};
use serde_json::{Value as Json, json};

use super::diff_runs;
use crate::args::{DiffArgs, Format, ValueArgs};
use crate::output::{group_digits, number, point, print, print_json, table};
use crate::scenes::load_scene;

pub(crate) fn run(args: &DiffArgs, engine: &Engine) -> anyhow::Result<bool> {
    if args.runs {
        return diff_runs::run(&args.first, &args.second, args.format);
    }
    let values = ValueArgs::default();
    let read = |path| load_scene(path, &args.read.options(), &values, Stop::default(), engine);
    let (first, second) = (read(&args.first)?.scene, read(&args.second)?.scene);
    let difference = Difference::between(&first, &second);
    let equal = difference.is_within(args.tolerance);
    if args.format == Format::Json {
        let objects: Vec<Json> = difference.objects.iter().map(object_json).collect();
        print_json(&json!({
            "first": args.first.display().to_string(),
            "second": args.second.display().to_string(),
            "equal": equal,
            "identical": difference.identical,
            "tolerance": args.tolerance,
            "only_first": difference.only_first,
            "only_second": difference.only_second,
            "objects": objects,
        }))?;
        return Ok(equal);
    }
    let files = [&args.first, &args.second].map(|path| path.display().to_string());
    let only = [&difference.only_first, &difference.only_second];
    for (names, file) in only.into_iter().zip(&files) {
        for name in names {
            print(&format!("{name}: only in {file}\n"))?;
        }
    }
    for object in &difference.objects {
        print(&object_text(object, &files))?;
    }
    print(&match (difference.identical, equal) {
        (true, _) => "identical bit for bit\n".to_owned(),
        (false, true) if args.tolerance == 0.0 => "equal\n".to_owned(),
        (false, true) => format!("equal within {}\n", args.tolerance),
        (false, false) => "different\n".to_owned(),
    })?;
    Ok(equal)
}

fn object_text(object: &ObjectDifference, files: &[String; 2]) -> String {
    let [name, other] = &object.names;
    let name = if name == other {
        name.clone()
    } else {
        format!("{name} and {other}")
    };
    let [kind, other] = object.kinds;
    if object.identical {
        return format!("{name}: {kind}, identical bit for bit\n");
    }
    if kind != other {
        return format!("{name}: {kind} in {}, {other} in {}\n", files[0], files[1]);
    }
    let mut text = format!("{name}: {kind}\n");
    match &object.mesh {
        Some(mesh) => text += &mesh_text(mesh, files),
        None => text += "  points differ\n",
    }
    let only = [&object.materials_only_first, &object.materials_only_second];
    for (names, file) in only.into_iter().zip(files) {
        for name in names {
            text += &format!("  material {name}: only in {file}\n");
        }
    }
    for name in &object.materials_differ {
        text += &format!("  material {name}: differs\n");
    }
    if object.materials_reordered {
        text += "  materials: in a different order\n";
    }
    text
}

fn mesh_text(mesh: &MeshDifference, files: &[String; 2]) -> String {
    let mut rows = vec![vec![String::new(), files[0].clone(), files[1].clone()]];
    for (what, show) in FACTS {
        let [a, b] = mesh.counts.each_ref().map(show);
        rows.push(vec![format!("  {what}"), a, b]);
    }
    let mut text = table(&rows);
    let mut line = |what: &str, value: &str| text += &format!("  {what:<14} {value}\n");
    line(
        "connectivity",
        match mesh.connectivity {
            Connectivity::Same => "the same",
            Connectivity::Reordered => "the same, except for the order of the vertices or faces",
            Connectivity::Different => "different",
        },
    );
    if mesh.connectivity == Connectivity::Same {
        let moved = match &mesh.moved {
            None => "the same".to_owned(),
            Some(m) => {
                let [n, all] = [m.count, mesh.counts[0].vertices].map(|n| group_digits(n as u64));
                format!(
                    "{n} of {all} differ; the largest difference is {} at {}",
                    number(m.by),
                    m.vertex
                )
            }
        };
        line("positions", &moved);
    }
    if let Some(distance) = &mesh.distance {
        let worst = distance.worst();
        line("distance", &largest(distance));
        let place = |at: &SurfacePoint| format!("{} at {}", at.on, point(at.position));
        let (from, to) = (place(&worst.from), place(&worst.to));
        line("", &format!("from {from} to {to}"));
        let way = usize::from(!distance.is_worst_forth());
        line("", &format!("the first point is on {}", files[way]));
        line("mean distance", &number(distance.mean()));
    }
    for attribute in &mesh.attributes {
        if attribute.difference != ColumnDifference::None {
            let name = format!("{} {}", attribute.domain, attribute.name);
            line(&name, &column_text(attribute, files));
        }
    }
    text
}

type Show = fn(&Counts) -> String;

const FACTS: [(&str, Show); 10] = [
    ("vertices", |c| group_digits(c.vertices as u64)),
    ("edges", |c| group_digits(c.edges as u64)),
    ("faces", |c| group_digits(c.faces as u64)),
    ("components", |c| group_digits(c.components as u64)),
    ("boundary loops", |c| group_digits(c.boundary_loops as u64)),
    ("area", |c| number(c.area)),
    ("volume", |c| match c.boundary_loops {
        0 => number(c.volume),
        _ => "open".to_owned(),
    }),
    ("bounds x", |c| extent(c, 0)),
    ("bounds y", |c| extent(c, 1)),
    ("bounds z", |c| extent(c, 2)),
];

/// Formats the lower and the upper bound of a mesh along one axis.
fn extent(counts: &Counts, axis: usize) -> String {
    match counts.bounds {
        Some([min, max]) => format!("{} to {}", number(min[axis]), number(max[axis])),
        None => "none".to_owned(),
    }
}

/// Formats the largest distance. If the upper bound `at_most` exceeds the computed distance, the computed distance is
/// only a lower bound, and both bounds are shown.
fn largest(distance: &Distance) -> String {
    let (largest, most) = (distance.largest(), distance.at_most());
    if most > largest {
        format!("at least {}, at most {}", number(largest), number(most))
    } else {
        number(largest)
    }
}

fn column_text(attribute: &AttributeDifference, files: &[String; 2]) -> String {
    match &attribute.difference {
        ColumnDifference::None => "the same".to_owned(),
        ColumnDifference::OnlyFirst => format!("only in {}", files[0]),
        ColumnDifference::OnlySecond => format!("only in {}", files[1]),
        ColumnDifference::Types([a, b]) => format!("{a} in {}, {b} in {}", files[0], files[1]),
        ColumnDifference::Rules => "different edit rules".to_owned(),
        ColumnDifference::Unknown => {
            "in both files, but not compared because the elements differ".to_owned()
        }
        ColumnDifference::Values { count, by, element } => {
            let n = group_digits(*count as u64);
            format!(
                "{n} values differ; the largest difference is {} at {element}",
                number(*by)
            )
        }
    }
}

fn object_json(object: &ObjectDifference) -> Json {
    let mut json = json!({
        "names": object.names,
        "kinds": object.kinds,
        "identical": object.identical,
        "materials": {
            "only_first": object.materials_only_first,
            "only_second": object.materials_only_second,
            "differ": object.materials_differ,
            "reordered": object.materials_reordered,
        },
    });
    if let Some(mesh) = &object.mesh {
        let attributes: Vec<Json> = mesh.attributes.iter().map(attribute_json).collect();
        let moved = |m: Moved| json!({ "count": m.count, "vertex": m.vertex.index(), "by": m.by });
        let distance = mesh.distance.as_ref().map(|d| {
            json!({
                "largest": d.largest(), "at_most": d.at_most(), "mean": d.mean(),
                "forth": side_json(&d.forth), "back": side_json(&d.back),
            })
        });
        json["mesh"] = json!({
            "counts": mesh.counts.each_ref().map(counts_json),
            "connectivity": match mesh.connectivity {
                Connectivity::Same => "same",
                Connectivity::Reordered => "reordered",
                Connectivity::Different => "different",
            },
            "moved": mesh.moved.map(moved),
            "attributes": attributes,
            "distance": distance,
        });
    }
    json
}

fn counts_json(counts: &Counts) -> Json {
    json!({
        "vertices": counts.vertices,
        "edges": counts.edges,
        "faces": counts.faces,
        "components": counts.components,
        "boundary_loops": counts.boundary_loops,
        "area": counts.area,
        "volume": counts.volume,
        "bounds": counts.bounds.map(|b| b.map(|p| p.to_array())),
    })
}

fn side_json(side: &OneSided) -> Json {
    let place = |place: &SurfacePoint| json!({ "on": place.on.to_string(), "position": place.position.to_array() });
    json!({
        "largest": side.largest, "at_most": side.at_most, "mean": side.mean,
        "from": place(&side.from), "to": place(&side.to),
    })
}

fn attribute_json(attribute: &AttributeDifference) -> Json {
    let mut json = json!({
        "domain": attribute.domain.to_string(),
        "name": attribute.name,
    });
    let word = match &attribute.difference {
        ColumnDifference::None => "none",
        ColumnDifference::OnlyFirst => "only_first",
        ColumnDifference::OnlySecond => "only_second",
        ColumnDifference::Types(types) => {
            json["types"] = json!(types);
            "types"
        }
        ColumnDifference::Rules => "rules",
        ColumnDifference::Unknown => "unknown",
        ColumnDifference::Values { count, by, element } => {
            json["count"] = json!(count);
            json["by"] = json!(by);
            json["element"] = json!(element);
            "values"
        }
    };
    json["difference"] = json!(word);
    json
}
