//! Accesses the XML of a COLLADA file: finds elements by id, reads numbers in the text of elements, and determines the
//! positions of errors.

use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};

use roxmltree::{Document as Xml, Error, ParsingOptions};

use super::cost;
use crate::fault::Fault;
use crate::note::{NoteKind, Notes};
use crate::text::{BYTE_ORDER_MARK, TextPosition, name, number, quoted};

pub(super) type Node<'a> = roxmltree::Node<'a, 'a>;

/// Decodes the text of a file as UTF-8 or, if it is not valid UTF-8, as Latin-1.
///
/// # Errors
///
/// Returns an error if the text has a byte order mark of UTF-16.
pub(super) fn decoded(bytes: &[u8]) -> Result<Cow<'_, str>, Fault> {
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err(TextPosition::START.error("expected text in UTF-8, found UTF-16"));
    }
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    Ok(match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(name(bytes)),
    })
}

/// Parses `text`. Document type declarations are refused, because they can define entities that expand to a huge text.
///
/// # Errors
///
/// Returns an error if the text is not XML. Also returns an error if parsing the text would take unusually much time or
/// memory for its size.
pub(super) fn parsed(text: &str) -> Result<Xml<'_>, Fault> {
    check_size(text)?;
    let options = ParsingOptions {
        allow_dtd: false,
        nodes_limit: u32::try_from(text.len() / 4 + 1000).unwrap_or(u32::MAX),
        ..ParsingOptions::default()
    };
    Xml::parse_with_options(text, options).map_err(|error| {
        let message = match error {
            Error::DtdDetected => "document type declarations are not supported".to_owned(),
            Error::NodesLimitReached => {
                "the file has far more elements than is usual for its size".to_owned()
            }
            _ => {
                let message = error.to_string();
                let end = message.rfind(" at ").unwrap_or(message.len());
                message[..end].to_owned()
            }
        };
        let pos = error.pos();
        let (line, column) = (pos.row as usize, pos.col as usize);
        TextPosition { line, column }.error(message)
    })
}

/// Refuses text for which the XML parser would take too much time or memory. The parser allocates an entry for each `<`
/// and `=`, and compares each attribute of an element with all others. It also copies the list of all namespaces for
/// each element that declares a namespace.
fn check_size(text: &str) -> Result<(), Fault> {
    const MAX_ATTRIBUTES: usize = 200;
    const MAX_NAMESPACES: usize = 50;
    const SMALL: usize = 8192;
    let bytes = text.as_bytes();
    let mut prefixes = BTreeSet::new();
    let mut in_tag = 0;
    let (mut tags, mut equals) = (0, 0);
    for (at, byte) in bytes.iter().enumerate() {
        match byte {
            b'<' => {
                tags += 1;
                in_tag = 0;
            }
            b'=' => {
                equals += 1;
                let value = bytes[at + 1..].iter().find(|b| !b.is_ascii_whitespace());
                in_tag += usize::from(matches!(value, Some(b'"' | b'\'')));
                if in_tag > MAX_ATTRIBUTES {
                    let message = format!(
                        "expected at most {MAX_ATTRIBUTES} attributes in an XML element, found more"
                    );
                    return Err(place_at(text, at).error(message));
                }
            }
            b':' if bytes[..at].ends_with(b"xmlns") => {
                let rest = &bytes[at + 1..bytes.len().min(at + 257)];
                let is_end = |b: &u8| matches!(b, b'=' | b' ' | b'\t' | b'\r' | b'\n');
                prefixes.insert(rest.split(is_end).next());
                if prefixes.len() > MAX_NAMESPACES {
                    let message = format!(
                        "expected at most {MAX_NAMESPACES} XML namespaces in the file, found more"
                    );
                    return Err(place_at(text, at).error(message));
                }
            }
            _ => {}
        }
    }
    if bytes.len() > SMALL && (tags > bytes.len() / 3 || equals > bytes.len() / 4) {
        return Err(TextPosition::START.error("expected XML"));
    }
    Ok(())
}

/// Returns the line and the column of the byte at offset `at`. Lines end with a line feed.
fn place_at(text: &str, at: usize) -> TextPosition {
    let before = &text.as_bytes()[..at.min(text.len())];
    let mut lines = before.split(|&b| b == b'\n');
    TextPosition {
        line: lines.clone().count(),
        column: lines.next_back().map_or(0, <[u8]>::len) + 1,
    }
}

/// The code of a note, and the text of the note without the count.
pub(super) type What = (&'static str, &'static str);

/// The notes about the file. The key is the kind, the text and the code of a note. The value is the count of the note
/// and the line of the first element that was counted.
type Tally = BTreeMap<(NoteKind, &'static str, &'static str), (usize, usize)>;

/// A parsed COLLADA file, with a map from ids to elements.
pub(super) struct Document<'a> {
    pub(super) root: Node<'a>,
    pub(super) ids: BTreeMap<&'a str, Node<'a>>,
    /// The size of the text in bytes.
    pub(super) size: usize,
    /// The content that was left out or changed.
    tally: RefCell<Tally>,
    /// The remaining memory budget of the file in bytes. The budget limits how often a file can instantiate the same
    /// geometry.
    budget: Cell<usize>,
}

impl<'a> Document<'a> {
    /// # Errors
    ///
    /// Returns an error if the root element is not `<COLLADA>`.
    pub(super) fn new(xml: &'a Xml<'a>) -> Result<Self, Fault> {
        let root = xml.root_element();
        if root.tag_name().name() != "COLLADA" {
            let found = quoted(root.tag_name().name().as_bytes());
            return Err(error_at(root, format!("expected <COLLADA>, found {found}")));
        }
        let mut ids = BTreeMap::new();
        for node in root.descendants() {
            if let Some(id) = node.attribute("id") {
                // If several elements have the same id, the first is used.
                ids.entry(id).or_insert(node);
            }
        }
        let size = xml.input_text().len();
        Ok(Self {
            root,
            ids,
            size,
            tally: RefCell::default(),
            budget: size
                .saturating_mul(cost::BUDGET_FACTOR)
                .max(cost::MIN_BUDGET)
                .into(),
        })
    }

    pub(super) fn left_out(&self, count: usize, node: Node, what: What) {
        self.add(NoteKind::LeftOut, count, node, what);
    }

    pub(super) fn changed(&self, count: usize, node: Node, what: What) {
        self.add(NoteKind::Changed, count, node, what);
    }

    fn add(&self, kind: NoteKind, count: usize, node: Node, what: What) {
        if count > 0 {
            // Determining the line of an element is slow, so a note contains only the line of the first element.
            let mut all = self.tally.borrow_mut();
            let (sum, _) = all
                .entry((kind, what.1, what.0))
                .or_insert_with(|| (0, line(node)));
            *sum = sum.saturating_add(count);
        }
    }

    /// Adds notes for everything that was left out or changed.
    pub(super) fn note_all(&self, notes: &mut Notes) {
        for ((kind, what, code), (count, line)) in self.tally.take() {
            notes.add(code, kind, count, Some(line), what.to_owned());
        }
    }

    /// Subtracts `bytes` from the remaining memory budget of the file.
    ///
    /// # Errors
    ///
    /// Returns an error if the memory budget is used up.
    pub(super) fn take(&self, node: Node, bytes: usize) -> Result<(), Fault> {
        let message = "the file repeats its content far more often than is usual for its size";
        let left = self.budget.get().checked_sub(bytes);
        self.budget
            .set(left.ok_or_else(|| error_at(node, message))?);
        Ok(())
    }

    /// Finds the element to which the attribute `key` of `node` refers. The value of the attribute has the form `#id`.
    /// The name of the element must be in `kind`. Returns `None` if the attribute refers to another file.
    ///
    /// # Errors
    ///
    /// Returns an error if the attribute is missing or is not a reference. Also returns an error if the element is
    /// missing or has a different name.
    pub(super) fn follow(
        &self,
        node: Node<'a>,
        key: &str,
        kind: &[&str],
    ) -> Result<Option<Node<'a>>, Fault> {
        let url = required(node, key)?;
        let Some(id) = url.trim().strip_prefix('#') else {
            if url.contains('#') || url.contains('/') {
                return Ok(None);
            }
            let found = quoted(url.as_bytes());
            let message = format!("expected {key}=\"#id\", found {found}");
            return Err(error_at(node, message));
        };
        self.find(node, id, kind).map(Some)
    }

    /// Finds the element with this id. The name of the element must be in `kind`. `node` is the element that contains
    /// the reference, and errors have its position.
    ///
    /// # Errors
    ///
    /// Returns an error if there is no element with this id, or if it has a different name.
    pub(super) fn find(&self, node: Node<'a>, id: &str, kind: &[&str]) -> Result<Node<'a>, Fault> {
        let found = self.ids.get(id).copied();
        let is_wanted = |found: &Node| kind.iter().any(|kind| is(*found, kind));
        found.filter(is_wanted).ok_or_else(|| {
            let kinds: Vec<String> = kind.iter().map(|kind| format!("<{kind}>")).collect();
            let kinds = kinds.join(" or ");
            let found = found.map_or_else(
                || "nothing".to_owned(),
                |found| format!("<{}>", found.tag_name().name()),
            );
            let id = quoted(id.as_bytes());
            error_at(
                node,
                format!("expected the id {id} to refer to an element {kinds}, found {found}"),
            )
        })
    }
}

/// Whether `node` is an element with this name.
pub(super) fn is(node: Node, name: &str) -> bool {
    node.is_element() && node.tag_name().name() == name
}

/// Returns the index of an element in its file, for use as a key.
pub(super) fn number_of(node: Node) -> u32 {
    node.id().get()
}

/// The child elements of `node`.
pub(super) fn elements(node: Node<'_>) -> impl Iterator<Item = Node<'_>> {
    node.children().filter(Node::is_element)
}

/// The child elements with this name.
pub(super) fn named<'a>(node: Node<'a>, name: &'static str) -> impl Iterator<Item = Node<'a>> {
    node.children().filter(move |child| is(*child, name))
}

/// The first child element with this name.
pub(super) fn child<'a>(node: Node<'a>, name: &'static str) -> Option<Node<'a>> {
    named(node, name).next()
}

/// Follows a path of element names. The first name belongs to a child of `node`, and each further name belongs to a
/// child of the previous element. Returns the element to which the last name belongs.
pub(super) fn below<'a>(node: Node<'a>, names: &[&'static str]) -> Option<Node<'a>> {
    names.iter().try_fold(node, |node, name| child(node, name))
}

/// The line in which an element begins.
pub(super) fn line(node: Node) -> usize {
    place(node).line
}

fn place(node: Node) -> TextPosition {
    place_at(node.document().input_text(), node.range().start)
}

/// Creates an error whose position is the beginning of an element.
pub(super) fn error_at(node: Node, message: impl Into<String>) -> Fault {
    let what = format!("<{}>: {}", node.tag_name().name(), message.into());
    place(node).error(what)
}

/// Returns the value of an attribute.
///
/// # Errors
///
/// Returns an error if the attribute is missing.
pub(super) fn required<'a>(node: Node<'a>, key: &str) -> Result<&'a str, Fault> {
    node.attribute(key)
        .ok_or_else(|| error_at(node, format!("expected an attribute `{key}`, found none")))
}

/// The value of an attribute as a non-negative integer; `None` if the attribute is missing.
///
/// # Errors
///
/// Returns an error if the value is not a non-negative integer.
pub(super) fn natural(node: Node, key: &str) -> Result<Option<usize>, Fault> {
    let Some(value) = node.attribute(key) else {
        return Ok(None);
    };
    let parsed = value.trim().parse().ok();
    parsed.map(Some).ok_or_else(|| {
        let found = quoted(value.as_bytes());
        error_at(
            node,
            format!("expected the attribute `{key}` to be a non-negative integer, found {found}"),
        )
    })
}

/// The text of an element without surrounding blanks.
pub(super) fn text(node: Node<'_>) -> &str {
    node.text().unwrap_or_default().trim()
}

/// The words in the text of an element, which are separated by white space.
fn words(node: Node<'_>) -> impl Iterator<Item = &str> {
    let texts = node.children().filter(Node::is_text);
    texts.flat_map(|text| text.text().unwrap_or_default().split_ascii_whitespace())
}

/// Reads the finite numbers in the text of an element.
///
/// # Errors
///
/// Returns an error at the first word that is not a finite number.
pub(super) fn numbers(node: Node) -> Result<Vec<f64>, Fault> {
    let parse = |word: &str| {
        let number = number(TextPosition::START, word.as_bytes());
        number.map_err(|error| word_place(node, word).error(error.message))
    };
    words(node).map(parse).collect()
}

/// Reads exactly `N` finite numbers in the text of an element.
///
/// # Errors
///
/// Returns an error if a word is not a number, or the number of words is not `N`.
pub(super) fn exactly<const N: usize>(node: Node) -> Result<[f64; N], Fault> {
    numbers(node)?.try_into().map_err(|found: Vec<f64>| {
        error_at(node, format!("expected {N} numbers, found {}", found.len()))
    })
}

/// Appends the indices in the text of an element to `list`.
///
/// # Errors
///
/// Returns an error if a word is not an index or is too large.
pub(super) fn push_indices(node: Node, list: &mut Vec<u32>) -> Result<(), Fault> {
    for word in words(node) {
        let expected = |_| word_place(node, word).expected("an index", word.as_bytes());
        list.push(word.parse().map_err(expected)?);
    }
    Ok(())
}

/// Returns the position of a word in the text of an element. If the text contains an entity, returns the position of
/// the element.
fn word_place(node: Node, word: &str) -> TextPosition {
    let text = node.document().input_text();
    let offset = (word.as_ptr() as usize).checked_sub(text.as_ptr() as usize);
    match offset {
        Some(offset) if offset < text.len() => place_at(text, offset),
        _ => place(node),
    }
}

/// Creates an error at word `k` of `lists`. The words of all elements in `lists` are numbered consecutively, beginning
/// with 0.
pub(super) fn word_error(lists: &[Node], mut k: usize, message: String) -> Fault {
    for &list in lists {
        for word in words(list) {
            if k == 0 {
                return word_place(list, word).error(message);
            }
            k -= 1;
        }
    }
    TextPosition::START.error(message)
}
