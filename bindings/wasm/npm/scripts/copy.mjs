// Copies the engine and the licences to where the package has them.
import { cpSync } from "node:fs";

cpSync("src/engine", "dist/engine", { recursive: true });
for (const licence of ["LICENSE-MIT", "LICENSE-APACHE"]) cpSync(`../../../${licence}`, licence);
