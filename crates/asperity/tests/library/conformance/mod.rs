//! What every law must hold, alone, on surfaces and under layers. A law is tested by being in one list: `conformance/laws.rs`.
//!
//! | file | what is tested |
//! |---|---|
//! | `alone` | one asperity and one pair of bodies: the contract of `Law` and the jumps that a law states |
//! | `contact` | one asperity on flats of all kinds: the contract of `MicroContact` |
//! | `models` | both models: integrals, sums, load control |

mod alone;
mod case;
mod contact;
mod laws;
mod models;
