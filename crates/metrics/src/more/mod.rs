//! Metrics of a picture that are one number each. A metric is a file here, with a function `of`, and a
//! line in the list below; the record has it as `more.NAME`.

mod distance;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::coverage::Layers;

/// Declares [`More`]: a field a metric, filled by the module of the same name.
macro_rules! metrics {
    ($($(#[doc = $what:literal])+ $name:ident,)+) => {
        /// The record's `more`: a number a metric, `None` where it does not apply.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(default)]
        #[schemars(deny_unknown_fields)]
        pub struct More {
            $($(#[doc = $what])+ pub $name: Option<f64>,)+
        }

        impl More {
            pub(crate) fn of(layers: &Layers<'_>) -> Self {
                Self { $($name: $name::of(layers),)+ }
            }
        }
    };
}

metrics! {
    /// Median relative error of the length of the reflected ray.
    distance,
}
