//! `catoptric doctor`: what renders here, and whether its clock can be believed.

use serde_json::json;

use crate::exit::Outcome;
use crate::options::Common;
use crate::run::load::open_gpu;
use crate::show::print;

/// Describes the adapter that measuring would use and tests its timestamps.
pub fn run(common: &Common) -> anyhow::Result<Outcome> {
    let gpu = open_gpu(common)?;
    let info = gpu.info();
    let test = gpu.timestamp_self_test();
    let features = [
        ("timestamp-query", info.timestamps),
        ("ray-query", info.ray_queries),
    ];
    let features: Vec<_> = features
        .iter()
        .filter(|(_, has)| *has)
        .map(|(name, _)| name)
        .collect();
    let facts = json!({
        "adapter": { "name": info.name, "driver": info.driver, "backend": info.backend, "software": info.software },
        "limits": { "max_image": info.max_image, "max_storage_binding": info.max_storage_binding },
        "features": features,
        "timestamps": test,
    });
    print::result(&print::facts(&facts, print::format(common)), common)?;
    Ok(Outcome::Done)
}
