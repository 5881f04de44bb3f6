//! One fault at a time, then any mesh at all.
