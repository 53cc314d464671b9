// The part of JSON Schema that the server's OpenAPI document uses, and nothing else: a keyword that is
// not known here is an error, so that none is passed over.
//
//   problems(schemas, { $ref: '#/components/schemas/Game' }, answer);   // [] if it fits

const known = new Set(['$ref', 'type', 'properties', 'required', 'items', 'enum', 'const', 'anyOf', 'additionalProperties',
  'minItems', 'maxItems', 'pattern', 'description']);
const reference = '#/components/schemas/';

const typeOf = (value) => (value === null ? 'null' : Array.isArray(value) ? 'array' : typeof value);
const isOf = (value, type) => (type === 'integer' ? Number.isInteger(value) : typeOf(value) === type);

/**
 * What does not fit, each with its place.
 * @param {Record<string, any>} schemas by name
 * @param {any} schema
 * @param {any} value
 * @param {string} place
 * @returns {string[]}
 */
export function problems(schemas, schema, value, place = '') {
  const strange = Object.keys(schema).filter((key) => !known.has(key));
  if (strange.length > 0) {
    return [`${place}: unknown keywords ${strange}`];
  }
  if (schema.$ref) {
    const name = schema.$ref.slice(reference.length);
    return schema.$ref.startsWith(reference) && schemas[name] ? problems(schemas, schemas[name], value, place)
      : [`${place}: ${schema.$ref} is not there`];
  }
  const found = [];
  if (schema.type && ![schema.type].flat().some((type) => isOf(value, type))) {
    found.push(`${place}: ${typeOf(value)} is not ${schema.type}`);
  }
  if (schema.enum && !schema.enum.includes(value)) {
    found.push(`${place}: ${JSON.stringify(value)} is none of ${schema.enum}`);
  }
  if ('const' in schema && value !== schema.const) {
    found.push(`${place}: ${JSON.stringify(value)} is not ${schema.const}`);
  }
  if (schema.pattern && typeof value === 'string' && !new RegExp(schema.pattern).test(value)) {
    found.push(`${place}: "${value}" does not match ${schema.pattern}`);
  }
  if (schema.anyOf && !schema.anyOf.some((each) => problems(schemas, each, value, place).length === 0)) {
    found.push(`${place}: fits none of ${schema.anyOf.length}`);
  }
  return [...found, ...(Array.isArray(value) ? inArray(schemas, schema, value, place)
    : typeOf(value) === 'object' ? inObject(schemas, schema, value, place) : [])];
}

function inArray(schemas, schema, value, place) {
  const { minItems = 0, maxItems = Infinity, items } = schema;
  const found = value.length < minItems || value.length > maxItems ? [`${place}: ${value.length} items`] : [];
  return items ? [...found, ...value.flatMap((item, i) => problems(schemas, items, item, `${place}/${i}`))] : found;
}

/** Where properties are listed, others are a problem too: the document is to be whole. */
function inObject(schemas, schema, value, place) {
  const { properties, required = [], additionalProperties } = schema;
  const found = required.filter((key) => !(key in value)).map((key) => `${place}/${key}: missing`);
  for (const [key, member] of Object.entries(value)) {
    const own = properties?.[key] ?? additionalProperties;
    if (own) {
      found.push(...problems(schemas, own, member, `${place}/${key}`));
    } else if (properties) {
      found.push(`${place}/${key}: not in the schema`);
    }
  }
  return found;
}
