//! `rough` in a spec.

use asperity_contact_framework::input::Forms;
use asperity_contact_framework::input::schema::TYPE;
use asperity_contact_framework::written_schema;
use serde::de::IgnoredAny;
use serde::{Deserialize, Deserializer};
use serde_json::json;

/// The name of one material: that of the other body is `flat`, also where it is rough.
#[derive(Debug, Clone)]
pub struct RoughBody(pub String);

written_schema!(RoughBody, |_| json!({ "type": "string", TYPE: "name of a material" }));

impl<'de> Deserialize<'de> for RoughBody {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Forms::new("the name of one material")
            .text(|name| Ok(Self(name.to_owned())))
            .list(|_: Vec<IgnoredAny>| {
                Err("found a list; allowed: one material, that of the rough body. For two rough bodies use \
                     [surface.NAME.pair], the sum of both height maps, with the second material as `flat`; or a population with the \
                     composite sigma and curvature"
                    .to_owned())
            })
            .read(deserializer)
    }
}
