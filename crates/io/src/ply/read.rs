//! From the tables of a PLY file to polygons.

use std::collections::BTreeSet;
use std::path::Path;

use glam::{DVec2, DVec3, DVec4};
use mesh::{COLOR, Column, Domain, Rule, UV, VERTEX_NORMAL, Values};
use rayon::prelude::*;

use super::body::Body;
use super::columns::{Kind, corner_values, indices, item_at, mend, numbers, values};
use super::header::{Element, Header, parse};
use super::marks::Mark;
use super::roles::{self, Roles};
use super::strips::triangles_of_strips;
use super::table::{BLOCK, Table};
use super::types::Type;
use crate::error::ReadError;
use crate::note::Notes;
use crate::{Found, Polygons};

/// Reads a PLY file from its bytes.
///
/// # Errors
///
/// The first place that breaks the rules of the format: line and column of a text and of the header, the byte
/// of binary values.
pub(crate) fn read(
    path: &Path,
    bytes: &[u8],
    name: String,
    notes: &mut Notes,
) -> Result<Found, ReadError> {
    let header = parse(bytes).map_err(|error| error.in_file(path))?;
    let roles = Roles::of(&header).map_err(|error| error.in_file(path))?;
    let wanted = |element: &Element| {
        let place = header.elements.iter().position(|e| e.name == element.name);
        place.is_some_and(|place| roles.wants(place))
    };
    let body = Body::new(path, bytes, &header, wanted, notes)?;
    let tables = body.tables(notes)?;
    for (place, element) in header.elements.iter().enumerate() {
        if !roles.wants(place) {
            let what = format!("rows of element `{}` left out", element.name.escape_debug());
            notes.left_out(element.rows, element.place.line, what);
        }
    }
    let mut reader = Reader {
        header: &header,
        body: &body,
        tables: &tables,
        marks: marks(&header),
        polygons: Polygons::default(),
        names: BTreeSet::new(),
        notes,
    };
    reader.polygons.positions = reader.positions(&roles)?;
    if let Some((element, list)) = roles.face {
        let (offsets, corners) = reader.indices(element, list)?;
        (reader.polygons.offsets, reader.polygons.corners) = (offsets, corners);
    } else if let Some((element, list)) = roles.strips {
        reader.strips(element, list)?;
    }
    reader.vertex_columns(&roles);
    if let Some((element, list)) = roles.face {
        reader.face_columns(element, list);
        reader.leave_small_faces_out();
    }
    Ok(Found::polygons(name, reader.polygons))
}

/// What comments say about properties that are there; of each only the first counts.
fn marks(header: &Header) -> Vec<Mark> {
    let properties = header.elements.iter().flat_map(|e| &e.properties);
    let names: BTreeSet<&str> = properties.map(|p| p.name.as_str()).collect();
    let mut marked = BTreeSet::new();
    let marks = header.comments.iter().filter_map(|c| Mark::parse(c));
    let mut is_first = |mark: &Mark| {
        names.contains(mark.property.as_str())
            && marked.insert((mark.domain, mark.property.clone()))
    };
    marks.filter(|mark| is_first(mark)).collect()
}

struct Reader<'a, 'n> {
    header: &'a Header,
    body: &'a Body<'a>,
    tables: &'a [Table<'a>],
    marks: Vec<Mark>,
    polygons: Polygons,
    /// The names of the columns that are there.
    names: BTreeSet<(Domain, String)>,
    notes: &'n mut Notes,
}

impl Reader<'_, '_> {
    fn positions(&self, roles: &Roles) -> Result<Vec<DVec3>, ReadError> {
        let table = &self.tables[roles.vertex];
        let positions = numbers(table, roles.position, DVec3::from_array);
        let blocks = positions.par_chunks(BLOCK).enumerate();
        let broken = blocks.find_map_first(|(block, positions)| {
            let row = positions.iter().position(|p| !p.is_finite())?;
            Some(block * BLOCK + row)
        });
        let Some(row) = broken else {
            return Ok(positions);
        };
        let axis = positions[row]
            .to_array()
            .iter()
            .position(|x| !x.is_finite());
        let property = roles.position[axis.unwrap_or(0)];
        let message = format!(
            "expected a finite number `{}`, found {}",
            ["x", "y", "z"][axis.unwrap_or(0)],
            positions[row].to_array()[axis.unwrap_or(0)]
        );
        Err(self
            .body
            .error(self.tables, (roles.vertex, property, row, 0), message))
    }

    /// The vertices of the rows of faces.
    fn indices(&self, element: usize, list: usize) -> Result<(Vec<u32>, Vec<u32>), ReadError> {
        let n = self.polygons.positions.len();
        indices(&self.tables[element], list, n).map_err(|bad| {
            let (row, item) = bad.unwrap_or_default();
            let message = match bad {
                Some(_) => format!(
                    "expected a vertex from 0 to below {n}, found {}",
                    item_at(&self.tables[element], list, row, item)
                ),
                None => format!("expected fewer than {} corners, found more", u32::MAX),
            };
            self.body
                .error(self.tables, (element, list, row, item), message)
        })
    }

    /// The triangles of strips, in which -1 ends a strip: every second one is turned round, and those
    /// that visit a vertex twice only lead on to the next.
    fn strips(&mut self, element: usize, list: usize) -> Result<(), ReadError> {
        let table = &self.tables[element];
        let (corners, strips, stitches) =
            triangles_of_strips(table, list, self.polygons.positions.len()).map_err(
                |(row, item, message)| {
                    self.body
                        .error(self.tables, (element, list, row, item), message)
                },
            )?;
        let line = self.header.elements[element].place.line;
        let n_triangles = u32::try_from(corners.len() / 3).unwrap_or(u32::MAX);
        self.polygons.offsets = (0..=n_triangles).map(|i| 3 * i).collect();
        let what = format!("triangle strips became {n_triangles} triangles");
        self.notes.changed(strips, line, what);
        let what = "triangles of strips left out: they visit a vertex twice";
        self.notes.changed(stitches, line, what);
        self.polygons.corners = corners;
        let others = (0..table.properties.len()).filter(|&p| p != list);
        let lost = others.count() * table.rows;
        self.notes
            .left_out(lost, line, "values of triangle strips left out");
        Ok(())
    }

    fn vertex_columns(&mut self, roles: &Roles) {
        let element = &self.header.elements[roles.vertex];
        let mut used = vec![false; element.properties.len()];
        mark_used(&mut used, &roles.position);
        self.marked(Domain::Vertex, roles.vertex, &mut used);
        self.normals_and_colors(Domain::Vertex, roles.vertex, &mut used);
        let per_corner = |element: &Element| element.list("texcoord").is_some();
        let has_uvs = roles
            .face
            .is_some_and(|(face, _)| per_corner(&self.header.elements[face]));
        if let Some(uv) = free(&used, roles::uv(element))
            && !self.polygons.corners.is_empty()
            && !has_uvs
        {
            mark_used(&mut used, &uv);
            let mut uvs = Values::Vec2(numbers(&self.tables[roles.vertex], uv, DVec2::from_array));
            let corners = &self.polygons.corners;
            let count = mend(&mut uvs);
            self.notes
                .changed(count, None, "texture coordinates that are not finite are 0");
            let uvs = uvs.gather(corners.len(), |c| Some(corners[c] as usize));
            self.insert(Domain::Corner, UV.name, UV.rule, uvs);
        }
        self.plain(Domain::Vertex, roles.vertex, &used);
    }

    fn face_columns(&mut self, place: usize, corners: usize) {
        let element = &self.header.elements[place];
        let table = &self.tables[place];
        let mut used = vec![false; element.properties.len()];
        used[corners] = true;
        self.marked(Domain::Face, place, &mut used);
        for mark in self.marks.clone() {
            let list = element.list(&mark.property);
            let Some(list) = list.filter(|&list| mark.domain == Domain::Corner && !used[list])
            else {
                continue;
            };
            let per = mark.kind.size();
            let degrees = self.polygons.offsets.windows(2).enumerate();
            let fits = fits(mark.kind, element.properties[list].value)
                && degrees.into_iter().all(|(row, ends)| {
                    table.count(list, row) == per * (ends[1] - ends[0]) as usize
                });
            if fits {
                used[list] = true;
                let (values, _) = corner_values(table, list, &self.polygons.offsets, mark.kind);
                self.insert(Domain::Corner, &mark.name, mark.rule, values);
            }
        }
        if let Some(list) = element.list("texcoord").filter(|&list| !used[list]) {
            used[list] = true;
            let offsets = &self.polygons.offsets;
            let (values, short) = corner_values(table, list, offsets, Kind::Vec2);
            let line = element.properties[list].place.line;
            let what = "faces have texture coordinates 0: `texcoord` has not two for each corner";
            self.notes.changed(short, line, what);
            self.insert(Domain::Corner, UV.name, UV.rule, values);
        }
        self.normals_and_colors(Domain::Face, place, &mut used);
        self.plain(Domain::Face, place, &used);
    }

    /// The columns that comments describe.
    fn marked(&mut self, domain: Domain, place: usize, used: &mut [bool]) {
        let element = &self.header.elements[place];
        for mark in self.marks.clone() {
            let Some(first) = element
                .scalar(&mark.property)
                .filter(|_| mark.domain == domain)
            else {
                continue;
            };
            let range = first..first + mark.kind.size();
            let properties = element.properties.get(range.clone());
            let fit = properties.is_some_and(|properties| {
                let mut all = properties.iter();
                all.all(|p| p.count.is_none() && fits(mark.kind, p.value))
            });
            if fit && !used[range.clone()].contains(&true) {
                used[range].fill(true);
                let values = values(&self.tables[place], first, mark.kind);
                self.insert(domain, &mark.name, mark.rule, values);
            }
        }
    }

    fn normals_and_colors(&mut self, domain: Domain, place: usize, used: &mut [bool]) {
        let element = &self.header.elements[place];
        let table = &self.tables[place];
        if let Some(normal) = free(used, roles::normal(element)) {
            mark_used(used, &normal);
            let normals = Values::Vec3(numbers(table, normal, DVec3::from_array));
            self.insert(domain, VERTEX_NORMAL.name, VERTEX_NORMAL.rule, normals);
        }
        let Some((rgb, alpha)) = roles::color(element) else {
            return;
        };
        if free(used, Some(rgb)).is_none() {
            return;
        }
        mark_used(used, &rgb);
        let unit = |p: usize| element.properties[p].value.color_unit();
        let units = DVec3::from_array(rgb.map(unit));
        let colors: Vec<DVec4> = match alpha.filter(|&alpha| !used[alpha]) {
            None => numbers(table, rgb, |c| (DVec3::from_array(c) / units).extend(1.0)),
            Some(alpha) => {
                used[alpha] = true;
                let units = units.extend(unit(alpha));
                let [r, g, b] = rgb;
                numbers(table, [r, g, b, alpha], |c| DVec4::from_array(c) / units)
            }
        };
        let rule = if domain == Domain::Vertex {
            COLOR.rule
        } else {
            Rule::Copy
        };
        self.insert(domain, COLOR.name, rule, Values::Vec4(colors));
    }

    /// Properties without a meaning, under their own names; lists are left out.
    fn plain(&mut self, domain: Domain, place: usize, used: &[bool]) {
        let table = &self.tables[place];
        let element = &self.header.elements[place];
        let unused = (0..used.len()).filter(|&p| !used[p]);
        for (p, property) in unused.map(|p| (p, &element.properties[p])) {
            if property.count.is_some() {
                let what = format!(
                    "lists `{}` of element `{}` left out",
                    property.name.escape_debug(),
                    element.name.escape_debug()
                );
                self.notes.left_out(table.rows, property.place.line, what);
                continue;
            }
            let values = match property.value {
                Type::Float32 | Type::Float64 => values(table, p, Kind::Float),
                Type::UInt32 => match values(table, p, Kind::Float) {
                    Values::Float(wide) if wide.iter().all(|&x| x <= f64::from(i32::MAX)) => {
                        drop(wide);
                        values(table, p, Kind::Int)
                    }
                    wide => wide,
                },
                _ => values(table, p, Kind::Int),
            };
            let rule = plain_rule(domain, property.value);
            self.insert(domain, &property.name, rule, values);
        }
    }

    /// Adds a column; a name that is taken gets a number.
    fn insert(&mut self, domain: Domain, name: &str, rule: Rule, mut values: Values) {
        let count = mend(&mut values);
        let what = format!(
            "values of `{}` that are not finite are 0",
            name.escape_debug()
        );
        self.notes.changed(count, None, what);
        let mut free = name.to_owned();
        let mut number = 2;
        while !self.names.insert((domain, free.clone())) {
            free = format!("{name} {number}");
            number += 1;
        }
        if free != name {
            let what = format!(
                "values are now called `{}`: the name is taken",
                free.escape_debug()
            );
            self.notes.changed(values.len(), None, what);
        }
        let column = Column {
            name: free,
            rule,
            values,
        };
        self.polygons.attributes.insert(domain, column);
    }

    fn leave_small_faces_out(&mut self) {
        let offsets = &self.polygons.offsets;
        let is_small = |ends: &[u32]| ends[1] - ends[0] < 3;
        let small = offsets
            .par_windows(2)
            .with_min_len(BLOCK)
            .filter(|ends| is_small(ends));
        let count = small.count();
        if count == 0 {
            return;
        }
        let what = "faces with fewer than 3 corners left out";
        self.notes.left_out(count, None, what);
        let mut faces = Vec::new();
        let mut corners = Vec::new();
        let mut ends = vec![0];
        for (f, range) in offsets.windows(2).enumerate() {
            if !is_small(range) {
                faces.push(f);
                corners.extend(range[0] as usize..range[1] as usize);
                ends.push(u32::try_from(corners.len()).expect("no more than before"));
            }
        }
        self.polygons.offsets = ends;
        self.polygons.corners = corners.iter().map(|&c| self.polygons.corners[c]).collect();
        let attributes = std::mem::take(&mut self.polygons.attributes);
        for (domain, mut column) in attributes {
            let kept = match domain {
                Domain::Face => Some(&faces),
                Domain::Corner => Some(&corners),
                Domain::Vertex | Domain::Edge => None,
            };
            if let Some(kept) = kept {
                column.values = column.values.gather(kept.len(), |i| Some(kept[i]));
            }
            self.polygons.attributes.insert(domain, column);
        }
    }
}

/// What edits do with the values of a property that no comment describes.
pub(super) fn plain_rule(domain: Domain, kind: Type) -> Rule {
    if domain == Domain::Vertex && kind.is_float() {
        Rule::Interpolate
    } else {
        Rule::Copy
    }
}

/// Whether values of a property of this type can be of this kind.
fn fits(kind: Kind, value: Type) -> bool {
    match kind {
        Kind::Tag => !value.is_float(),
        Kind::Int => !value.is_float() && value != Type::UInt32,
        Kind::Float | Kind::Vec2 | Kind::Vec3 | Kind::Vec4 => true,
    }
}

fn mark_used(used: &mut [bool], properties: &[usize]) {
    for &p in properties {
        used[p] = true;
    }
}

/// The properties, if none of them is used.
fn free<const N: usize>(used: &[bool], properties: Option<[usize; N]>) -> Option<[usize; N]> {
    properties.filter(|properties| !properties.iter().any(|&p| used[p]))
}
