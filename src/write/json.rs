//! JSON laid out for reading and for line-by-line comparison: a key a line, and
//! the elements of its long lists a line each.

use serde::Serialize;

/// A JSON object that is put together key by key.
pub(super) struct Document {
    text: String,
}

impl Document {
    /// An object without keys.
    pub fn new() -> Self {
        Self { text: "{".into() }
    }

    /// Adds a key whose value stands on the key's line.
    ///
    /// # Errors
    /// What serde says, for values that JSON cannot hold.
    pub fn value<T: Serialize + ?Sized>(
        &mut self,
        key: &str,
        value: &T,
    ) -> Result<(), serde_json::Error> {
        self.key(key)?;
        self.text += &serde_json::to_string(value)?;
        Ok(())
    }

    /// Adds a key whose value is a list with one element a line.
    ///
    /// # Errors
    /// What serde says, for values that JSON cannot hold.
    pub fn list<T: Serialize>(&mut self, key: &str, list: &[T]) -> Result<(), serde_json::Error> {
        self.key(key)?;
        self.text.push('[');
        for (i, element) in list.iter().enumerate() {
            self.text += if i == 0 { "\n  " } else { ",\n  " };
            self.text += &serde_json::to_string(element)?;
        }
        self.text += if list.is_empty() { "]" } else { "\n]" };
        Ok(())
    }

    /// Adds a key whose value is another object, laid out the same way.
    ///
    /// # Errors
    /// What serde says of the key.
    pub fn nested(&mut self, key: &str, inner: Self) -> Result<(), serde_json::Error> {
        self.key(key)?;
        self.text += inner.finish().trim_end();
        Ok(())
    }

    /// Adds a key whose value is a list of other objects, laid out the same way.
    ///
    /// # Errors
    /// What serde says of the key.
    pub fn nested_list(&mut self, key: &str, list: Vec<Self>) -> Result<(), serde_json::Error> {
        self.key(key)?;
        let list: Vec<String> =
            list.into_iter().map(|inner| inner.finish().trim_end().to_owned()).collect();
        self.text += &format!("[{}]", list.join(", "));
        Ok(())
    }

    /// The text of the object.
    pub fn finish(mut self) -> String {
        self.text += "\n}\n";
        self.text
    }

    fn key(&mut self, key: &str) -> Result<(), serde_json::Error> {
        self.text += if self.text == "{" { "\n" } else { ",\n" };
        self.text += &serde_json::to_string(key)?;
        self.text += ": ";
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_takes_a_line_an_element() {
        let mut document = Document::new();
        document.value("kerf", &1.5).unwrap();
        document.list("bars", &[[1, 2], [3, 4]]).unwrap();
        document.list("none", &[0; 0]).unwrap();
        let text = document.finish();
        assert_eq!(
            text,
            "{\n\"kerf\": 1.5,\n\"bars\": [\n  [1,2],\n  [3,4]\n],\n\"none\": []\n}\n"
        );
        assert!(serde_json::from_str::<serde_json::Value>(&text).is_ok());
    }
}
