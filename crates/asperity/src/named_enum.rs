//! Enumerations whose variants have names.

/// An enumeration without fields, each variant with its name in specs and tables: `Area = "area"`. It has the constant `ALL`, in
/// the order written, and the method `name`.
#[macro_export]
macro_rules! named_enum {
    ($(#[$about:meta])* pub enum $type:ident {
        $($(#[$of_variant:meta])* $variant:ident = $name:literal,)+
    }) => {
        $(#[$about])*
        pub enum $type {
            $($(#[$of_variant])* $variant,)+
        }

        impl $type {
            /// All of them.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$variant),+];

            /// The name in specs and tables.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)+
                }
            }
        }
    };
}
