//! `bindgen IN.wasm FOLDER`: writes `engine_bg.wasm` and its glue `engine.js`, `engine.d.ts`, which load in browsers,
//! bundlers and Node alike. The library behind wasm-bindgen's own program, so that one lock file pins all of it.

mod traps;

use std::process::ExitCode;

use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [input, folder] = arguments.as_slice() else {
        eprintln!("usage: bindgen IN.wasm FOLDER");
        return ExitCode::from(2);
    };
    let mut bindgen = Bindgen::new();
    let done = bindgen
        .input_path(input)
        .out_name("engine")
        .typescript(true)
        .remove_name_section(true)
        .remove_producers_section(true)
        .omit_default_module_path(false)
        .web(true)
        .and_then(|bindgen| bindgen.generate_output())
        .and_then(|mut output| {
            traps::trap(output.wasm_mut());
            // Says for linkers what is in it: browsers see for themselves.
            output.wasm_mut().customs.remove_raw("target_features");
            output.emit(folder)
        });
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error:#}");
            ExitCode::FAILURE
        }
    }
}
