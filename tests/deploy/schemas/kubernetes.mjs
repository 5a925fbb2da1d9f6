// Prints what is wrong with the objects of Kubernetes and KEDA on the standard input, a JSON list.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const require = createRequire(import.meta.url);

// The class of the objects of this kind, with the check that its schema was compiled into.
function model({ apiVersion, kind }) {
  const keda = apiVersion.startsWith("keda.sh/");
  const models = keda ? "@kubernetes-models/keda" : "kubernetes-models";
  return require(`${models}/${apiVersion}/${kind}`)[kind];
}

// The value, whose fields are in `unread` until somebody reads them. A check reads what it knows.
function watched(value, path, unread) {
  if (typeof value !== "object" || value === null) return value;
  const fields = Array.isArray(value) ? [] : {};
  const pathOf = (key) => `${path}/${String(key).replaceAll("/", "~1")}`;
  for (const [key, field] of Object.entries(value)) {
    unread.add(pathOf(key));
    fields[key] = watched(field, pathOf(key), unread);
  }
  return new Proxy(fields, {
    get(target, key) {
      unread.delete(pathOf(key));
      return target[key];
    },
  });
}

function mistakes(object) {
  const unread = new Set();
  try {
    model(object).prototype.validate.call(watched(object, "", unread));
  } catch (error) {
    return [error.message];
  }
  const holder = (field) => field.slice(0, field.lastIndexOf("/"));
  return [...unread].filter((field) => !unread.has(holder(field)))
    .map((field) => `${field}: unknown field`);
}

for (const object of JSON.parse(readFileSync(0, "utf8"))) {
  for (const mistake of mistakes(object)) {
    console.log(`${object.kind} ${object.metadata.name}: ${mistake}`);
  }
}
