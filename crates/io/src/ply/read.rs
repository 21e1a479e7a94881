//! Converts the tables of a PLY file to polygons.

use std::collections::BTreeSet;

use glam::{DVec2, DVec3, DVec4};
use mesh::{COLOR, Column, Domain, Rule, UV, VERTEX_NORMAL, Values};

use super::attribute_comments::AttributeComment;
use super::body::Body;
use super::columns::{Kind, Source, indices, item_at, numbers, values};
use super::header::{Element, Header, Property, parse};
use super::roles::{self, Roles};
use super::strips::triangles_of_strips;
use super::table::Table;
use super::types::Type;
use crate::Polygons;
use crate::clean::keep;
use crate::fault::Fault;
use crate::note::Notes;
use crate::writing::zero_non_finite;
use mesh::parallel;

/// Reads a PLY file from its bytes.
///
/// # Errors
///
/// Returns an error for the first position that violates the format. In a text file or a header, the position is a line
/// and a column. In binary values, it is the offset of a byte.
pub(crate) fn read(bytes: &[u8], notes: &mut Notes) -> Result<Polygons, Fault> {
    let header = parse(bytes)?;
    let roles = Roles::of(&header)?;
    let wanted = |element: &Element| {
        let place = header.elements.iter().position(|e| e.name == element.name);
        place.is_some_and(|place| roles.uses(place))
    };
    let body = Body::new(bytes, &header, wanted, notes)?;
    let tables = body.tables(notes)?;
    roles.note_unused(&header, notes);
    let mut reader = Reader {
        header: &header,
        body: &body,
        tables: &tables,
        comments: attribute_comments(&header),
        polygons: Polygons::default(),
        names: BTreeSet::new(),
        notes,
    };
    reader.polygons.positions = reader.positions(&roles)?;
    if let Some((element, list)) = roles.face {
        (reader.polygons.offsets, reader.polygons.corners) = reader.indices(element, list)?;
    } else if let Some((element, list)) = roles.strips {
        reader.strips(element, list)?;
    }
    reader.vertex_columns(&roles);
    if let Some((element, list)) = roles.face {
        reader.face_columns(element, list);
        reader.drop_small_faces();
    }
    Ok(reader.polygons)
}

/// Returns the comments that describe attributes and name an existing property. If several comments with the same
/// domain describe the same property, only the first of them is returned.
pub(super) fn attribute_comments(header: &Header) -> Vec<AttributeComment> {
    let properties = header.elements.iter().flat_map(|e| &e.properties);
    let names: BTreeSet<&str> = properties.map(|p| p.name.as_str()).collect();
    let mut described = BTreeSet::new();
    let comments = header
        .comments
        .iter()
        .filter_map(|c| AttributeComment::parse(c));
    let mut is_first = |comment: &AttributeComment| {
        names.contains(comment.property.as_str())
            && described.insert((comment.domain, comment.property.clone()))
    };
    comments.filter(|comment| is_first(comment)).collect()
}

/// Adds a note on a list that is left out.
pub(super) fn note_list(property: &Property, element: &Element, rows: usize, notes: &mut Notes) {
    let what = format!("lists {property} of {element} left out");
    notes.left_out("properties", rows, property.place.line, what);
}

struct Reader<'a, 'n> {
    header: &'a Header,
    body: &'a Body<'a>,
    tables: &'a [Table<'a>],
    comments: Vec<AttributeComment>,
    polygons: Polygons,
    /// The domains and names of the columns that were added so far.
    names: BTreeSet<(Domain, String)>,
    notes: &'n mut Notes,
}

impl Reader<'_, '_> {
    fn positions(&self, roles: &Roles) -> Result<Vec<DVec3>, Fault> {
        let table = &self.tables[roles.vertex];
        let positions = numbers(table, roles.position, DVec3::from_array);
        if parallel::all(positions.len(), |row| positions[row].is_finite()) {
            return Ok(positions);
        }
        let numbers = positions.iter().flat_map(DVec3::to_array).enumerate();
        let non_finite = numbers.into_iter().find(|(_, x)| !x.is_finite());
        let (i, found) = non_finite.unwrap_or_default();
        let (row, axis) = (i / 3, i % 3);
        let name = ["x", "y", "z"][axis];
        let message =
            format!("expected the coordinate `{name}` to be a finite number, found {found}");
        let place = (roles.vertex, roles.position[axis], row, 0);
        Err(self.body.error(self.tables, place, message))
    }

    /// Returns the offsets of the faces, and the vertex indices of their corners.
    fn indices(&self, element: usize, list: usize) -> Result<(Vec<u32>, Vec<u32>), Fault> {
        let n = self.polygons.positions.len();
        let table = &self.tables[element];
        indices(table, list, n).map_err(|bad| {
            let (row, item) = bad.unwrap_or_default();
            let message = if bad.is_some() {
                let found = item_at(table, list, row, item);
                format!("expected a vertex index below {n}, found {found}")
            } else {
                format!("expected fewer than {} corners, found more", u32::MAX)
            };
            self.body
                .error(self.tables, (element, list, row, item), message)
        })
    }

    /// Converts triangle strips to triangles. Triangles that use a vertex twice are left out, because they only connect
    /// parts of a strip.
    fn strips(&mut self, element: usize, list: usize) -> Result<(), Fault> {
        let table = &self.tables[element];
        let found = triangles_of_strips(table, list, self.polygons.positions.len());
        let (corners, strips, stitches) = found.map_err(|(row, item, message)| {
            self.body
                .error(self.tables, (element, list, row, item), message)
        })?;
        let line = self.header.elements[element].place.line;
        let n = corners.len() / 3;
        self.polygons.offsets = Polygons::even_offsets(n, 3);
        self.polygons.corners = corners;
        let what = format!("triangle strips converted to {n} triangles");
        self.notes.changed("strips-converted", strips, line, what);
        let what = "triangles of strips left out because they visit a vertex twice";
        self.notes.changed("strips-converted", stitches, line, what);
        let lost = (table.properties.len() - 1) * table.rows;
        self.notes.left_out(
            "strip-values",
            lost,
            line,
            "values of triangle strips left out",
        );
        Ok(())
    }

    fn vertex_columns(&mut self, roles: &Roles) {
        let element = &self.header.elements[roles.vertex];
        let mut used = vec![false; element.properties.len()];
        mark_used(&mut used, &roles.position);
        self.described(Domain::Vertex, roles.vertex, &mut used);
        self.normals_and_colors(Domain::Vertex, roles.vertex, &mut used);
        let faces = roles.face.map(|(face, _)| &self.header.elements[face]);
        let has_uvs = faces.is_some_and(|faces| faces.list("texcoord").is_some());
        if let Some(uv) = free(&used, roles::uv(element))
            && !self.polygons.corners.is_empty()
            && !has_uvs
        {
            mark_used(&mut used, &uv);
            let mut uvs = Values::Vec2(numbers(&self.tables[roles.vertex], uv, DVec2::from_array));
            let corners = &self.polygons.corners;
            let what = "non-finite texture coordinates set to 0";
            self.notes
                .changed("values-not-finite", zero_non_finite(&mut uvs), None, what);
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
        self.described(Domain::Face, place, &mut used);
        self.described(Domain::Corner, place, &mut used);
        if let Some(list) = element.list("texcoord").filter(|&list| !used[list]) {
            used[list] = true;
            let source = Source::List(list, &self.polygons.offsets);
            let (values, short) = values(table, source, Kind::Vec2);
            let line = element.properties[list].place.line;
            let what = "faces whose texture coordinates are set to 0: `texcoord` does not have 2 numbers for each corner";
            self.notes.changed("uvs-missing", short, line, what);
            self.insert(Domain::Corner, UV.name, UV.rule, values);
        }
        self.normals_and_colors(Domain::Face, place, &mut used);
        self.plain(Domain::Face, place, &used);
    }

    /// Adds the attribute columns that comments describe.
    fn described(&mut self, domain: Domain, place: usize, used: &mut [bool]) {
        let element = &self.header.elements[place];
        let table = &self.tables[place];
        let is_list = domain == Domain::Corner;
        for comment in self
            .comments
            .clone()
            .iter()
            .filter(|comment| comment.domain == domain)
        {
            let Some(first) = element.find(&comment.property, is_list) else {
                continue;
            };
            let size = comment.kind.size();
            let range = first..first + if is_list { 1 } else { size };
            let properties = element.properties.get(range.clone());
            let is_right =
                |p: &Property| p.count.is_some() == is_list && fits(comment.kind, p.value);
            let mut rows = self.polygons.offsets.windows(2).enumerate();
            let fit = properties.is_some_and(|properties| properties.iter().all(is_right))
                && (!is_list
                    || rows.all(|(row, ends)| {
                        table.count(first, row) == size * (ends[1] - ends[0]) as usize
                    }));
            if fit && !used[range.clone()].contains(&true) {
                used[range].fill(true);
                let source = if is_list {
                    Source::List(first, &self.polygons.offsets)
                } else {
                    Source::Scalars(first)
                };
                let (values, _) = values(table, source, comment.kind);
                self.insert(domain, &comment.name, comment.rule, values);
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

    /// For each property that is not used yet, adds an attribute with the name of the property. Lists are left out.
    fn plain(&mut self, domain: Domain, place: usize, used: &[bool]) {
        let table = &self.tables[place];
        let element = &self.header.elements[place];
        let unused = (0..used.len()).filter(|&p| !used[p]);
        for (p, property) in unused.map(|p| (p, &element.properties[p])) {
            if property.count.is_some() {
                note_list(property, element, table.rows, self.notes);
                continue;
            }
            let of_kind = |kind| values(table, Source::Scalars(p), kind).0;
            let fits = |x: &f64| *x <= f64::from(i32::MAX);
            let values = match property.value {
                Type::Float32 | Type::Float64 => of_kind(Kind::Float),
                Type::UInt32 => match of_kind(Kind::Float) {
                    Values::Float(wide) if wide.iter().all(fits) => of_kind(Kind::Int),
                    wide => wide,
                },
                _ => of_kind(Kind::Int),
            };
            let rule = plain_rule(domain, property.value);
            self.insert(domain, &property.name, rule, values);
        }
    }

    /// Adds a column. If the name is taken, a number is appended to it.
    fn insert(&mut self, domain: Domain, name: &str, rule: Rule, mut values: Values) {
        let what = format!("non-finite values of `{}` set to 0", name.escape_debug());
        self.notes.changed(
            "values-not-finite",
            zero_non_finite(&mut values),
            None,
            what,
        );
        let mut free = name.to_owned();
        let mut number = 2;
        while !self.names.insert((domain, free.clone())) {
            free = format!("{name} {number}");
            number += 1;
        }
        if free != name {
            let (old, new) = (name.escape_debug(), free.escape_debug());
            let what = format!(
                "values of attribute `{old}` stored as attribute `{new}`, because another attribute is named `{old}`"
            );
            self.notes
                .changed("attributes-renamed", values.len(), None, what);
        }
        let column = Column {
            name: free,
            rule,
            values,
        };
        self.polygons.attributes.insert(domain, column);
    }

    fn drop_small_faces(&mut self) {
        let offsets = &self.polygons.offsets;
        let n = self.polygons.n_faces();
        let is_small = |f: usize| offsets[f + 1] - offsets[f] < 3;
        let count = parallel::count(n, is_small);
        let what = "faces with fewer than 3 corners left out";
        self.notes.left_out("faces-too-small", count, None, what);
        if count > 0 {
            let is_small: Vec<bool> = (0..n).map(is_small).collect();
            keep(&mut self.polygons, &is_small, &[]);
        }
    }
}

/// Returns the edit rule of an attribute that no comment describes. The edit rule defines how an edit computes the
/// value of the attribute at a new element.
pub(super) fn plain_rule(domain: Domain, kind: Type) -> Rule {
    if domain == Domain::Vertex && kind.is_float() {
        Rule::Interpolate
    } else {
        Rule::Copy
    }
}

/// Whether a property of this type can store values of this kind.
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

/// Returns the properties unchanged, or `None` if one of them is already used for another attribute.
fn free<const N: usize>(used: &[bool], properties: Option<[usize; N]>) -> Option<[usize; N]> {
    properties.filter(|properties| !properties.iter().any(|&p| used[p]))
}
