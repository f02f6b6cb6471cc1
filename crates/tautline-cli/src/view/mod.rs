//! `tautline view`: the playground, served to this machine alone and opened in its browser.

mod browser;
mod files;

use std::path::PathBuf;

use tautline_scene::registry;
use tiny_http::{Header, Method, Request, Response, Server};

use crate::args::View;
use crate::failure::Failure;
use crate::output::{json, print};
use crate::scene::find;
use files::{Files, Served};

/// The playground as `cargo xtask web` builds it, in the folder that this program was built from.
const BUILT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../playground/dist");
/// The name that a scene file is served by; the page asks for it if its address ends in `#served`.
const SCENE: &str = "scene.json";

pub(crate) fn view(arguments: &View) -> Result<(), Failure> {
    let mut files = Files::of(&folder(arguments)?)?;
    let fragment = match &arguments.scene {
        None => String::new(),
        Some(scene) => fragment(scene, &arguments.set, &mut files)?,
    };
    let refused = |error| Failure::Usage(format!("port {}: {error}", arguments.port));
    let server = Server::http(("127.0.0.1", arguments.port)).map_err(refused)?;
    let port = server.server_addr().to_ip().map_or(arguments.port, |address| address.port());
    let address = format!("http://127.0.0.1:{port}/{fragment}");
    print(&format!("{address}\nServed to this machine alone; Ctrl+C ends it.\n"))?;
    if !arguments.no_open {
        browser::open(&address);
    }
    let own_names = [format!("127.0.0.1:{port}"), format!("localhost:{port}")];
    for request in server.incoming_requests() {
        // Who closes the connection early does not want the answer.
        let _ = answer(request, &files, &own_names);
    }
    Ok(())
}

/// Where the playground is.
fn folder(arguments: &View) -> Result<PathBuf, Failure> {
    let folder = arguments.page.clone().unwrap_or_else(|| PathBuf::from(BUILT));
    if folder.join("index.html").is_file() {
        return Ok(folder);
    }
    let how = "`cargo xtask web` in tautline's source folder builds it; --page DIR says where it is";
    Err(Failure::Usage(format!("the playground is not in {}: {how}", folder.display())))
}

/// The part of the address that names a scene. A file is read and checked here, its meshes too, and served.
fn fragment(scene: &str, assignments: &[String], files: &mut Files) -> Result<String, Failure> {
    let document = find(scene, assignments)?;
    if registry::find(scene).is_err() {
        files.add(SCENE, json(&document)?.into_bytes());
        return Ok("#served".to_owned());
    }
    // `find` has accepted them: names and numbers, which need no escaping.
    let set: String = assignments.iter().map(|assignment| format!("&{}", assignment.replace(' ', ""))).collect();
    Ok(format!("#scene={scene}{set}"))
}

/// Answers with a file of the build, or refuses. A request by another name than this machine's comes from a page
/// elsewhere that has pointed its own name here: it gets nothing.
fn answer(request: Request, files: &Files, own_names: &[String]) -> std::io::Result<()> {
    let host = request.headers().iter().find(|header| header.field.equiv("Host"));
    let is_own = host.is_some_and(|host| own_names.iter().any(|name| host.value.as_str() == name));
    if !is_own {
        return request.respond(Response::empty(403));
    }
    if !matches!(request.method(), Method::Get | Method::Head) {
        return request.respond(Response::empty(405));
    }
    let Some(Served { bytes, kind }) = files.get(request.url()) else {
        return request.respond(Response::empty(404));
    };
    let mut response = Response::from_data(bytes);
    for (name, value) in [("Content-Type", kind), ("Cache-Control", "no-cache"), ("X-Content-Type-Options", "nosniff")] {
        if let Ok(header) = Header::from_bytes(name, value) {
            response.add_header(header);
        }
    }
    request.respond(response)
}
