//! How a viewer finds its way in the file: the outline and the names of the pages.
//!
//! Pages that follow each other in one chapter hang below an entry of it, closed at first:
//! of a hundred pages one sees the chapters.

use super::Page;
use lopdf::{Dictionary, Document, Object, ObjectId};

/// An entry of the outline.
struct Entry<'a> {
    title: &'a str,
    /// The page that it leads to.
    page: usize,
    children: Vec<Entry<'a>>,
}

/// The entries of all pages that have one.
fn entries(pages: &[Page]) -> Vec<Entry<'_>> {
    let mut entries: Vec<Entry> = Vec::new();
    let mut open: Option<&str> = None;
    for (page, found) in pages.iter().enumerate() {
        let Some(title) = found.title.as_deref() else { continue };
        let entry = Entry { title, page, children: Vec::new() };
        let chapter = found.chapter.as_deref();
        match (chapter, entries.last_mut()) {
            (None, _) => entries.push(entry),
            (Some(_), Some(last)) if chapter == open => last.children.push(entry),
            (Some(title), _) => entries.push(Entry { title, page, children: vec![entry] }),
        }
        open = chapter;
    }
    entries
}

/// Adds the outline of the pages to the file. Returns whether there is one.
pub(super) fn add(file: &mut Document, pages: &[Page]) -> lopdf::Result<bool> {
    let entries = entries(pages);
    if entries.is_empty() {
        return Ok(false);
    }
    let targets: Vec<ObjectId> = file.page_iter().collect();
    let root = file.new_object_id();
    let mut outline = hang(file, &entries, root, &targets);
    outline.set("Type", "Outlines");
    outline.set("Count", entries.len() as i64);
    file.objects.insert(root, outline.into());
    file.catalog_mut()?.set("Outlines", root);
    Ok(true)
}

/// Adds entries below a parent, and returns what the parent says of them.
fn hang(
    file: &mut Document,
    entries: &[Entry],
    parent: ObjectId,
    targets: &[ObjectId],
) -> Dictionary {
    let ids: Vec<ObjectId> = entries.iter().map(|_| file.new_object_id()).collect();
    for (i, entry) in entries.iter().enumerate() {
        let mut item = hang(file, &entry.children, ids[i], targets);
        if !entry.children.is_empty() {
            // Below zero: its entries are not shown until it is opened.
            item.set("Count", -(entry.children.len() as i64));
        }
        item.set("Title", lopdf::text_string(entry.title));
        item.set("Parent", parent);
        item.set("Dest", vec![Object::from(targets[entry.page]), "Fit".into()]);
        if i > 0 {
            item.set("Prev", ids[i - 1]);
        }
        if let Some(&next) = ids.get(i + 1) {
            item.set("Next", next);
        }
        file.objects.insert(ids[i], item.into());
    }
    let mut said = Dictionary::new();
    if let (Some(&first), Some(&last)) = (ids.first(), ids.last()) {
        said.set("First", first);
        said.set("Last", last);
    }
    said
}

/// Names the pages as they are printed: by their labels, or else by their numbers.
pub(super) fn label(file: &mut Document, pages: &[Page]) -> lopdf::Result<()> {
    let mut labels: Vec<Object> = Vec::new();
    let mut numbered = false;
    for (i, page) in pages.iter().enumerate() {
        let mut label = Dictionary::new();
        match &page.label {
            Some(name) => label.set("P", lopdf::text_string(name)),
            // A run of numbers is said once.
            None if numbered => continue,
            None => {
                label.set("S", "D");
                label.set("St", i as i64 + 1);
            }
        }
        numbered = page.label.is_none();
        labels.extend([(i as i64).into(), label.into()]);
    }
    let mut tree = Dictionary::new();
    tree.set("Nums", labels);
    file.catalog_mut()?.set("PageLabels", tree);
    Ok(())
}
