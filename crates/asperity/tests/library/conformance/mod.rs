//! The contract of every law: single contacts, surfaces and layers. Each law of the registry is tested; statements of
//! its own documentation are in `laws`.
//!
//! | file | what is tested |
//! |---|---|
//! | `alone` | one asperity and one pair of bodies: the contract of `Law` and the jumps that a law states |
//! | `contact` | one asperity on flats of all kinds: the contract of `MicroContact` |
//! | `registered` | the registry: names, options, equality |
//! | `own` | a law of another crate, tested like the others |
//! | `models` | both models: integrals, sums, load control |

mod alone;
mod case;
mod contact;
mod laws;
mod models;
mod own;
mod registered;
