//! The handout's text, CommonMark, taken apart into what is printed below each other.
//!
//! Headings, paragraphs, lists, bold and slanted words (both are printed bold), rules and
//! pictures of the model are known; links are printed as their words. Comments are left out.
//! Anything else is refused by its name: a page that silently lacks a part helps nobody.

use crate::drawing::Weight;
use pulldown_cmark::{Event, HeadingLevel, Parser, Tag, TagEnd};

/// What stands on a page of the handout.
#[derive(Clone, PartialEq, Debug)]
pub(in crate::sheets) enum Block {
    /// A heading, the largest of level 1.
    Heading(usize, Vec<Word>),
    /// Running text, inside so many lists; the first of an entry has its sign or number.
    Paragraph {
        /// How many lists it stands in.
        depth: usize,
        /// `•` or `3.`, printed before it.
        label: Option<String>,
        /// The text.
        words: Vec<Word>,
    },
    /// Pictures beside each other.
    Pictures(Vec<Picture>),
    /// A line across the page.
    Rule,
}

/// What is printed without a space within.
#[derive(Clone, PartialEq, Debug, Default)]
pub(in crate::sheets) struct Word {
    /// Its parts and their weights.
    pub parts: Vec<(String, Weight)>,
    /// Whether a new line begins behind it.
    pub ends_line: bool,
}

/// A picture and the words below it.
#[derive(Clone, PartialEq, Debug)]
pub(in crate::sheets) struct Picture {
    /// What it shows.
    pub of: Subject,
    /// The words below it.
    pub caption: String,
}

/// What a picture of the handout can show.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(in crate::sheets) enum Subject {
    /// The model from the side and above.
    Isometric,
    /// The model from above.
    Plan,
    /// One unit, large.
    Unit,
    /// The card of a rod of that unit, at full size.
    RodCard,
}

/// The names of pictures in a text.
const SUBJECTS: [(&str, Subject); 4] = [
    ("picture:isometric", Subject::Isometric),
    ("picture:plan", Subject::Plan),
    ("picture:unit", Subject::Unit),
    ("picture:rod-card", Subject::RodCard),
];

/// What cannot be printed.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(in crate::sheets) struct Unprintable {
    /// Some of the text, by which it is found.
    pub near: String,
    /// What is wrong and what to do.
    pub problem: String,
}

/// The blocks of a text, from top to bottom.
pub(in crate::sheets) fn blocks(text: &str) -> Result<Vec<Block>, Unprintable> {
    let mut reader = Reader::default();
    for (event, range) in Parser::new(text).into_offset_iter() {
        let near = text[range].lines().next().unwrap_or_default();
        reader.take(event, near)?;
    }
    Ok(reader.blocks)
}

#[derive(Default)]
struct Reader {
    blocks: Vec<Block>,
    /// The number of the next entry of each list that is open; none of those with signs.
    lists: Vec<Option<u64>>,
    label: Option<String>,
    /// The words of the paragraph that is open.
    words: Vec<Word>,
    /// Whether what comes next belongs to the last word.
    glued: bool,
    bold: usize,
    pictures: Vec<Picture>,
    /// The picture whose caption is read.
    open: Option<Picture>,
}

impl Reader {
    fn take(&mut self, event: Event<'_>, near: &str) -> Result<(), Unprintable> {
        match event {
            Event::Start(tag) => self.start(tag, near)?,
            Event::End(tag) => self.end(tag, near)?,
            Event::Text(text) | Event::Code(text) => self.text(&text),
            Event::SoftBreak => self.text(" "),
            Event::HardBreak => {
                self.glued = false;
                if let Some(word) = self.words.last_mut() {
                    word.ends_line = true;
                }
            }
            Event::Rule => self.blocks.push(Block::Rule),
            Event::Html(html) | Event::InlineHtml(html) => {
                if !html.trim_start().starts_with("<!--") && !self.in_comment(&html) {
                    return Err(refused(near, "HTML is not printed, only comments are left out"));
                }
            }
            other => return Err(refused(near, &format!("{other:?} is not printed"))),
        }
        Ok(())
    }

    /// A comment over several lines comes line by line; its last one ends it.
    fn in_comment(&self, html: &str) -> bool {
        !html.contains('<') || html.trim_end().ends_with("-->")
    }

    fn start(&mut self, tag: Tag<'_>, near: &str) -> Result<(), Unprintable> {
        match tag {
            Tag::Paragraph | Tag::Heading { .. } | Tag::HtmlBlock => self.flush(),
            Tag::List(first) => {
                self.flush();
                self.lists.push(first);
            }
            Tag::Item => {
                self.label = match self.lists.last_mut() {
                    Some(Some(number)) => {
                        *number += 1;
                        Some(format!("{}.", *number - 1))
                    }
                    _ => Some("•".to_owned()),
                };
            }
            Tag::Strong | Tag::Emphasis => self.bold += 1,
            Tag::Link { .. } => {}
            Tag::Image { dest_url, .. } => {
                let Some((_, of)) = SUBJECTS.iter().find(|(name, _)| *name == &*dest_url) else {
                    let names = SUBJECTS.map(|(name, _)| name).join(", ");
                    let problem = format!("there is no picture {dest_url}: there are {names}");
                    return Err(Unprintable { near: dest_url.to_string(), problem });
                };
                self.open = Some(Picture { of: *of, caption: String::new() });
            }
            Tag::CodeBlock(_) => {
                let what = "a block of code is not printed: begin its lines further left";
                return Err(refused(near, what));
            }
            Tag::BlockQuote(_) => return Err(refused(near, "a quotation (>) is not printed")),
            other => return Err(refused(near, &format!("{other:?} is not printed"))),
        }
        Ok(())
    }

    fn end(&mut self, tag: TagEnd, near: &str) -> Result<(), Unprintable> {
        match tag {
            TagEnd::Paragraph => self.flush(),
            TagEnd::Item => {
                self.flush();
                self.label = None;
            }
            TagEnd::Heading(level) => {
                let words = std::mem::take(&mut self.words);
                self.glued = false;
                self.blocks.push(Block::Heading(size(level), words));
            }
            TagEnd::List(_) => drop(self.lists.pop()),
            TagEnd::Strong | TagEnd::Emphasis => self.bold -= 1,
            TagEnd::Image => {
                if !self.words.is_empty() {
                    let what = "a picture stands in a paragraph of its own: leave a line empty \
                                before and after it";
                    return Err(refused(near, what));
                }
                self.pictures.extend(self.open.take());
            }
            _ => {}
        }
        Ok(())
    }

    fn text(&mut self, text: &str) {
        if let Some(picture) = &mut self.open {
            picture.caption.push_str(text);
            return;
        }
        let weight = if self.bold > 0 { Weight::Bold } else { Weight::Regular };
        for (i, part) in text.split(' ').enumerate() {
            // A space ends the word before it.
            self.glued &= i == 0;
            if part.is_empty() {
                continue;
            }
            if !self.glued {
                self.words.push(Word::default());
            }
            if let Some(word) = self.words.last_mut() {
                word.parts.push((part.to_owned(), weight));
            }
            self.glued = true;
        }
    }

    /// Ends the paragraph that is open.
    fn flush(&mut self) {
        self.glued = false;
        if !self.pictures.is_empty() {
            self.blocks.push(Block::Pictures(std::mem::take(&mut self.pictures)));
        }
        let words = std::mem::take(&mut self.words);
        if !words.is_empty() {
            let (depth, label) = (self.lists.len(), self.label.take());
            self.blocks.push(Block::Paragraph { depth, label, words });
        }
    }
}

fn size(level: HeadingLevel) -> usize {
    level as usize
}

fn refused(near: &str, problem: &str) -> Unprintable {
    Unprintable { near: near.trim().to_owned(), problem: problem.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(words: &[Word]) -> String {
        let word = |w: &Word| {
            let parts: String = w
                .parts
                .iter()
                .map(|(text, weight)| match weight {
                    Weight::Bold => format!("<{text}>"),
                    Weight::Regular => text.clone(),
                })
                .collect();
            if w.ends_line { format!("{parts}/") } else { parts }
        };
        words.iter().map(word).collect::<Vec<_>>().join(" ")
    }

    fn shown(text: &str) -> Vec<String> {
        let show = |block: Block| match block {
            Block::Heading(level, words) => format!("{level}# {}", plain(&words)),
            Block::Paragraph { depth, label, words } => {
                format!("{depth} {} {}", label.unwrap_or_default(), plain(&words))
            }
            Block::Pictures(all) => {
                let one = |p: &Picture| format!("{:?}: {}", p.of, p.caption);
                all.iter().map(one).collect::<Vec<_>>().join(" | ")
            }
            Block::Rule => "---".to_owned(),
        };
        blocks(text).unwrap().into_iter().map(show).collect()
    }

    #[test]
    fn words_stay_together_whatever_their_weight() {
        let text = "# The **roof**\n\nIt is *light*, and\n**very** [strong](x).  \nYes<!-- no -->.";
        assert_eq!(shown(text), ["1# The <roof>", "0  It is <light>, and <very> strong./ Yes."]);
    }

    #[test]
    fn lists_are_numbered_and_may_hold_others() {
        let text = "3. three\n   - a\n   - b\n4. four\n\n   more\n\nend";
        let expected = ["1 3. three", "2 • a", "2 • b", "1 4. four", "1  more", "0  end"];
        assert_eq!(shown(text), expected);
    }

    #[test]
    fn pictures_of_a_paragraph_stand_beside_each_other() {
        let text = "a\n\n![From *above*](picture:plan) ![Side](picture:isometric)\n\n---\n";
        assert_eq!(shown(text), ["0  a", "Plan: From above | Isometric: Side", "---"]);
    }

    #[test]
    fn what_is_not_printed_is_refused_by_name() {
        for (text, near, words) in [
            ("a\n\n    code", "code", "block of code"),
            ("> a", "> a", "quotation"),
            ("a <b>x</b>", "<b>", "HTML"),
            ("<table>\n</table>", "<table>", "HTML"),
            ("![x](picture:roof)", "picture:roof", "there are picture:isometric"),
            ("a ![x](picture:plan)", "![x](picture:plan)", "paragraph of its own"),
        ] {
            let found = blocks(text).unwrap_err();
            assert!(found.near == near && found.problem.contains(words), "{text}: {found:?}");
        }
        let comment = "<!-- one\ntwo\n-->\n\na";
        assert_eq!(shown(comment), ["0  a"]);
    }
}
