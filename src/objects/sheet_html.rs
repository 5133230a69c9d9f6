//! The sheet as a web page that needs no network: pictures are part of the text.

use std::fmt::Write as _;
use std::io::Cursor;

use cinesplat_files::base64;
use image::{ImageFormat, RgbImage};

use super::error::ObjectsError;
use super::sheet::{Sheet, Tile};

/// Style of the page: parts are indented under their whole.
const STYLE: &str = "body{margin:24px;background:#18181c;color:#f2f2f2;font:16px/1.4 sans-serif}img{display:block;\
border-radius:4px}.all{width:100%;max-width:1400px;margin-bottom:8px}main{display:grid;gap:16px;margin-top:24px;\
grid-template-columns:repeat(auto-fill,minmax(240px,1fr))}section{background:#232329;border-radius:6px;padding:8px}\
section img{width:100%}p{margin:6px 0}b{color:#ffd75e}.part{margin:8px 0 0 24px}code{color:#9fd3ff}";

impl Sheet {
    /// The sheet as HTML: the overviews, then every whole with its parts.
    ///
    /// # Errors
    /// [`ObjectsError::Picture`] where a picture cannot be encoded.
    pub fn html(&self, title: &str) -> Result<String, ObjectsError> {
        let title = escaped(title);
        let mut page = format!(
            "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{title}</title>\
             <style>{STYLE}</style></head>\n<body><h1>{title}</h1>\n\
             <p>Name an object with <code>--name ID=NAME</code>; <code>&lt;obj-ID&gt;</code> in a prompt always works.</p>\n",
        );
        for overview in &self.overviews {
            // Writing to a string cannot fail.
            let _ = writeln!(page, "<img class=\"all\" alt=\"the scene\" src=\"{}\">", data_uri(overview)?);
        }
        page.push_str(&self.up_section()?);
        page.push_str("<main>\n");
        let mut is_open = false;
        for tile in &self.tiles {
            if tile.depth == 0 {
                page.push_str(if is_open { "</section>\n<section>" } else { "<section>" });
                is_open = true;
            }
            page.push_str(&entry(tile)?);
        }
        page.push_str(if is_open { "</section>\n" } else { "" });
        page.push_str("</main></body></html>\n");
        Ok(page)
    }

    /// The directions that may be up; empty where up is known.
    fn up_section(&self) -> Result<String, ObjectsError> {
        if self.up_views.is_empty() {
            return Ok(String::new());
        }
        let mut text = "<h2>Which way is up?</h2>\n<main>\n".to_owned();
        for view in &self.up_views {
            let [likely, flag] = view.caption();
            let picture = data_uri(&view.picture)?;
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "<section><img alt=\"{flag}\" src=\"{picture}\"><p>{likely} <code>{flag}</code></p></section>"
            );
        }
        text.push_str("</main>\n<h2>Objects</h2>\n");
        Ok(text)
    }
}

fn entry(tile: &Tile) -> Result<String, ObjectsError> {
    let (id, label, picture) = (tile.id, escaped(&tile.label), data_uri(&tile.picture)?);
    let class = if tile.depth > 0 { " class=\"part\"" } else { "" };
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(text, "<div{class}><img alt=\"{label}\" src=\"{picture}\"><p><b>{id}</b> {label}</p></div>");
    Ok(text)
}

fn data_uri(picture: &RgbImage) -> Result<String, ObjectsError> {
    let mut bytes = Cursor::new(Vec::new());
    let written = picture.write_to(&mut bytes, ImageFormat::Png);
    written.map_err(|error| ObjectsError::Picture { reason: error.to_string() })?;
    Ok(format!("data:image/png;base64,{}", base64::encode(bytes.get_ref())))
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
