//! `egg` compiles project files into elastic geodesic grids: curved lightweight structures that
//! are cut as straight, flat, thin lamellae, bolted together flat, and unfold into a doubly
//! curved surface (Pillwein, Kübert, Rist, Musialski, *Design and fabrication of multi-patch
//! elastic geodesic grid structures*, 2021).
//!
//! The modules stand in the order in which data passes them; a stage knows the stages before it,
//! never those after it:
//!
//! 1. [`project`]: the language; text to a checked model with spans.
//! 2. [`surface`]: the design surface as a triangle mesh.
//! 3. [`geodesic`]: exact shortest geodesics between arbitrary surface points.
//! 4. [`layout`]: anchors, edges and geodesic quadrilaterals (patches), strips.
//! 5. [`cladding`]: distance maps, the planar quad, cladding functions, choice of angle.
//! 6. [`members`]: even distribution of members, exact refinement.
//! 7. [`grid`]: crossings, notches, lamellae, the flat state.
//! 8. [`plan`]: the document that says everything about the structure.
//! 9. [`fabrication`]: parts, sheets, drawings (DXF, SVG), bill of materials.
//! 10. [`diff`]: the difference of two plans, for review.
//!
//! [`build`] runs the stages over a cached dependency graph, [`diagnostics`] is how every stage
//! talks to the user, and [`cli`] is the only module that knows the terminal.

pub mod build;
pub mod cladding;
pub mod cli;
pub mod diagnostics;
pub mod diff;
pub mod fabrication;
pub mod geodesic;
pub mod grid;
pub mod layout;
pub mod members;
pub mod plan;
pub mod project;
pub mod splitting;
pub mod surface;
