// The page that plays a recording, as one file: `tautline run … --out x.html` puts the recording into it.
import { createHash } from "node:crypto";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { type Plugin, defineConfig } from "vite";

/** Where the engine's exporter has it from; a test has it made elsewhere, and compares. */
const TEMPLATE = process.env.REPLAY ?? fileURLToPath(new URL("../crates/tautline-scene/src/export/html/replay.html", import.meta.url));

const CHARSET = '<meta charset="utf-8" />';

/** Puts scripts and styles into the page, and allows these and no others. */
function inline(): Plugin {
  return {
    name: "inline",
    enforce: "post",
    generateBundle(_options, bundle) {
      const files = Object.values(bundle);
      const script = files.map((file) => (file.type === "chunk" ? file.code : "")).join("");
      const style = files.map((file) => (file.type === "asset" && file.fileName.endsWith(".css") ? String(file.source) : "")).join("");
      const page = files.find((file) => file.fileName.endsWith(".html"));
      if (page?.type !== "asset") throw new Error("there is no page");
      // The end of the element must not stand in the script, and the exporter's mark only once.
      const code = script.trim().replaceAll("</script", "<\\/script");
      const allowed = `default-src 'none'; script-src '${hash(code)}'; style-src '${hash(style)}'; base-uri 'none'; form-action 'none'`;
      const html = String(page.source)
        .replace(/\s*<(script|link)\b[^>]*(src|href)=[^>]*>(<\/script>)?/g, "")
        .replace("</title>", () => `</title>\n    <style>${style}</style>\n    <script type="module">${code}</script>`)
        .replace(CHARSET, `${CHARSET}\n    <meta http-equiv="Content-Security-Policy" content="${allowed}" />`);
      for (const name of Object.keys(bundle)) delete bundle[name];
      // One that is the same keeps its time: nothing that includes it is compiled again.
      if (!existsSync(TEMPLATE) || readFileSync(TEMPLATE, "utf8") !== html) writeFileSync(TEMPLATE, html);
    },
  };
}

function hash(text: string): string {
  return `sha256-${createHash("sha256").update(text).digest("base64")}`;
}

export default defineConfig({
  base: "./",
  publicDir: false,
  build: {
    target: "es2022",
    outDir: "dist-replay",
    modulePreload: false,
    cssCodeSplit: false,
    rolldownOptions: { input: "recording.html" },
  },
  plugins: [inline()],
});
