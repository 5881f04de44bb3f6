//! A budget of work: steps are counted, not seconds, so that the same plan comes on every
//! machine.

/// Work that may still be done, in additions of two numbers or so.
#[derive(Clone, Debug)]
pub struct Work {
    left: usize,
}

/// About a second. Plans of some hundred rods from one length mostly take a tenth of it. Less, and
/// more plans are left unproven.
const MOST: usize = 1_200_000_000;

impl Default for Work {
    fn default() -> Self {
        Self::of(MOST)
    }
}

impl Work {
    /// So much work.
    pub fn of(left: usize) -> Self {
        Self { left }
    }

    /// Takes some off; false, and nothing taken, if there is not so much left.
    pub fn spend(&mut self, some: usize) -> bool {
        let left = self.left.checked_sub(some);
        self.left = left.unwrap_or(self.left);
        left.is_some()
    }
}
