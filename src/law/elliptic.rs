//! stub
/// Shape
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// radius
    pub radius: f64,
    /// spheres
    pub spheres: f64,
}
impl Shape {
    /// sphere
    pub fn sphere(radius: f64) -> Self { Self { radius, spheres: 1.0 } }
    /// ellipse
    pub fn ellipse(mean_curvature: f64, _ratio: f64) -> Self { Self::sphere(mean_curvature.recip()) }
}
