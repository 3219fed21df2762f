//! Exact shortest geodesics on a triangle mesh between arbitrary surface points.
