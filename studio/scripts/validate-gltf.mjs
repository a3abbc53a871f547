// Prints the Khronos glTF validator's reports of the files named, as one JSON array.
// Exit status: 0 no errors, 1 at least one file has errors, 2 bad use.
import { readFile } from "node:fs/promises";
import { basename } from "node:path";
import validator from "gltf-validator";

const files = process.argv.slice(2);
if (files.length === 0) {
  console.error("usage: node scripts/validate-gltf.mjs FILE.glb ...");
  process.exit(2);
}

const reports = [];
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {
    uri: basename(file),
    maxIssues: 0,
  });
  reports.push({ file, ...report });
}
console.log(JSON.stringify(reports, null, 2));
process.exitCode = reports.some((report) => report.issues.numErrors > 0) ? 1 : 0;
