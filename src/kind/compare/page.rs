pub mod causes {
    pub use crate::kind::compare::figures::causes::colour;
}
pub mod figures {
    pub use crate::kind::compare::figures::curves::regime_colour;
}
pub mod verdict {
    pub use crate::kind::compare::outline::{limit_words, name};
    use asperity::compare::ComparedQuantity;
    use asperity_framework::report::format::{input_quantity, number, percent};
    pub fn loads([from, to]: [f64; 2]) -> String {
        let [a, b] = [from, to].map(|load| input_quantity(load, "Pa"));
        if from == to { a } else { format!("{a} to {b}") }
    }
    pub fn signed(compared: ComparedQuantity, contrast: f64) -> String {
        let reported = compared.reported(contrast);
        match compared {
            ComparedQuantity::Separation => format!("{} σ", number(reported)),
            _ => percent(reported),
        }
    }
}
