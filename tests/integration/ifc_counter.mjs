// Counts what web-ifc finds in a file: node ifc_counter.mjs MODULES FILE
// Prints JSON; what each count is says test_ifc_readers.py, which counts the same by ifcopenshell.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

const [modules, file] = process.argv.slice(2);
const { IfcAPI, FILE_DESCRIPTION } = createRequire(join(modules, "..", "package.json"))("web-ifc");
const api = new IfcAPI();
await api.Init();
const model = api.OpenModel(new Uint8Array(readFileSync(file)));

const counts = {};
const count = (part, key, by = 1) => {
  const own = (counts[part] ??= {});
  own[key] = (own[key] ?? 0) + by;
};
const classOf = (line) => api.GetNameFromTypeCode(line.type);
const line = (handle) => api.GetLine(model, handle.value ?? handle);
const lines = (name) => {
  const ids = api.GetLineIDsWithType(model, api.GetTypeCodeFromName(name.toUpperCase()));
  return Array.from({ length: ids.size() }, (_, index) => line(ids.get(index)));
};

/** The names of the materials that stand behind one of IFC's ways to name them. */
function materials(found) {
  switch (classOf(found)) {
    case "IfcMaterial":
      return [found.Name.value];
    case "IfcMaterialLayerSet":
      return found.MaterialLayers.flatMap((one) => materials(line(line(one).Material)));
    case "IfcMaterialConstituentSet":
      return found.MaterialConstituents.flatMap((one) => materials(line(line(one).Material)));
    default:
      throw new Error(`a material by ${classOf(found)}`);
  }
}

function countDefinition(element, found) {
  const kind = `${classOf(element)} ${found.Name.value}`;
  for (const one of (found.HasProperties ?? []).map(line)) {
    const { value } = one.NominalValue;
    const told = { T: true, F: false }[value] ?? value;
    const known = typeof told === "number" ? "" : ` ${told}`;
    count("properties", `${kind} ${one.Name.value}${known}`);
  }
  for (const one of (found.Quantities ?? []).map(line)) {
    const measure = one.LengthValue ?? one.AreaValue ?? one.VolumeValue;
    count("quantities", `${kind} ${one.Name.value}`, measure.value);
  }
}

function countAxes(wall) {
  for (const shape of line(wall.Representation).Representations.map(line)) {
    if (shape.RepresentationIdentifier.value !== "Axis") continue;
    const points = line(shape.Items[0]).Points.map((one) => line(one).Coordinates.map(({ value }) => value));
    const steps = points.slice(1).map(([x, y], index) => Math.hypot(x - points[index][0], y - points[index][1]));
    count("axes", classOf(wall));
    count("axes", "metres", steps.reduce((sum, one) => sum + one, 0));
  }
}

/** The extent of each class as it is drawn; web-ifc draws with y up. */
function measure(extents) {
  api.StreamAllMeshes(model, (mesh) => {
    const kind = classOf(line(mesh.expressID));
    const box = (extents[kind] ??= { shapes: 0, volume: 0, low: [1e9, 1e9, 1e9], high: [-1e9, -1e9, -1e9] });
    box.shapes += 1;
    for (let part = 0; part < mesh.geometries.size(); part += 1) {
      const { geometryExpressID, flatTransformation: m } = mesh.geometries.get(part);
      const shape = api.GetGeometry(model, geometryExpressID);
      const corners = [];
      const raw = api.GetVertexArray(shape.GetVertexData(), shape.GetVertexDataSize());
      for (let at = 0; at < raw.length; at += 6) {
        const [x, y, z] = [0, 1, 2].map(
          (row) => m[row] * raw[at] + m[4 + row] * raw[at + 1] + m[8 + row] * raw[at + 2] + m[12 + row],
        );
        corners.push([x, -z, y]);
        [x, -z, y].forEach((value, axis) => {
          box.low[axis] = Math.min(box.low[axis], value);
          box.high[axis] = Math.max(box.high[axis], value);
        });
      }
      const index = api.GetIndexArray(shape.GetIndexData(), shape.GetIndexDataSize());
      for (let at = 0; at < index.length; at += 3) {
        box.volume += signed(corners[index[at]], corners[index[at + 1]], corners[index[at + 2]]);
      }
    }
  });
}

/** Of the tetrahedron from the origin to a triangle. */
function signed(a, b, c) {
  return (
    (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
  );
}

for (const { typeName } of api.GetAllTypesOfModel(model)) {
  for (const one of lines(typeName)) if (one.ObjectPlacement !== undefined) count("elements", classOf(one));
}
for (const relation of lines("IfcRelAssociatesMaterial")) {
  for (const one of relation.RelatedObjects.map(line)) {
    for (const name of materials(line(relation.RelatingMaterial))) count("materials", `${classOf(one)} ${name}`);
  }
}
for (const relation of lines("IfcRelDefinesByType")) {
  const type = line(relation.RelatingType);
  for (const one of relation.RelatedObjects.map(line)) {
    count("types", `${classOf(one)} ${classOf(type)} ${type.Name.value}`);
  }
}
for (const relation of lines("IfcRelDefinesByProperties")) {
  const found = line(relation.RelatingPropertyDefinition);
  for (const one of relation.RelatedObjects.map(line)) countDefinition(one, found);
}
for (const wall of lines("IfcWall")) countAxes(wall);
for (const one of lines("IfcRelConnectsPathElements")) {
  count("connections", `${one.RelatingConnectionType.value} ${one.RelatedConnectionType.value}`);
}
for (const one of lines("IfcRelSpaceBoundary")) {
  const element = classOf(line(one.RelatedBuildingElement));
  count("boundaries", `${element} ${one.InternalOrExternalBoundary.value}`);
}
for (const one of lines("IfcStyledItem")) {
  for (const style of one.Styles.map(line)) count("colours", style.Name.value);
}
counts.extents = {};
measure(counts.extents);
counts.schema = api.GetModelSchema(model);
counts.view = api.GetHeaderLine(model, FILE_DESCRIPTION).arguments[0].map(({ value }) => value);
console.log(JSON.stringify(counts));
