//! What every law must hold, alone, on surfaces and under layers. A law is tested by being in the registry; what its
//! documentation states beyond the contract of all is in `laws`.
//!
//! | file | what is tested |
//! |---|---|
//! | `alone` | one asperity and one pair of bodies: the contract of `Law` and the jumps that a law states |
//! | `contact` | one asperity on flats of all kinds: the contract of `MicroContact` |
//! | `registered` | the registry: names, options, equality |
//! | `own` | a law from outside of the library, which is tested as the others are |
//! | `models` | both models: integrals, sums, load control |

mod alone;
mod case;
mod contact;
mod laws;
mod models;
mod own;
mod registered;
