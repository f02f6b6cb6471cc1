// Validates GLB files with the Khronos validator: one line per message on standard output; exit code 1 if any
// is an error or a warning.
import { readFileSync } from 'node:fs';
import validator from 'gltf-validator';

const SEVERITIES = ['error', 'warning', 'info', 'hint'];
let failed = false;
for (const path of process.argv.slice(2)) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(path)));
  for (const { severity, code, message, pointer } of report.issues.messages) {
    console.log(`${path}: ${SEVERITIES[severity]}: ${code} at ${pointer}: ${message}`);
  }
  failed ||= report.issues.numErrors > 0 || report.issues.numWarnings > 0;
}
process.exitCode = failed ? 1 : 0;
