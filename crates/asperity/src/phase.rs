#![allow(missing_docs)]
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::time::Instant;
pub static T: [AtomicU64; 64] = [const { AtomicU64::new(0) }; 64];
pub struct On(usize, Instant);
pub fn on(k: usize) -> On { On(k, Instant::now()) }
impl Drop for On { fn drop(&mut self) { T[self.0].fetch_add(self.1.elapsed().as_nanos() as u64, Relaxed); T[32+self.0].fetch_add(1, Relaxed);} }
const NAMES: [&str; 20] = ["new-moments","new-conv","coarser","finer","setup","keep_load","follow","find_contact","turn","bound","respond-rows","multiply","displace","change_p","settle","find_gaps","contact","moments","advance","stencil"];
pub fn print(what: &str) { let mut s=String::new(); for (k,n) in NAMES.iter().enumerate() { let t=T[k].swap(0,Relaxed); let c=T[32+k].swap(0,Relaxed); if c>0 { s+=&format!(" {n} {:.2}/{c}", t as f64*1e-6);} } eprintln!("{what}:{s}"); }
