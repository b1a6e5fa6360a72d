//! Tests of the library against reference vectors, closed forms and itself. One program, so that it is linked once.

mod bem;
mod coated;
mod common;
mod conformance;
mod ellipses;
mod exact_sphere;
mod files;
mod formats;
mod heights;
mod invariants;
mod joint;
mod layered_flat;
mod layered_rough;
mod lists;
mod measured;
mod npy;
mod progress;
mod reference;
mod small_maps;
mod surfaces;
mod units;
