//! Drawings in millimetres, drawn once and rendered to SVG and PDF.
