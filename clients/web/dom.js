// Elements from plain values. Text is always text: nothing here reads HTML.
//
//   const row = h('tr', { class: 'own' }, h('td', {}, name), h('td', {}, '3 : 1'));

/** @typedef {Node | string | number | null | undefined | false} Child */

/**
 * @param {Element} element
 * @param {Record<string, any>} attributes
 */
function setAttributes(element, attributes) {
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith('on') && typeof value === 'function') {
      element.addEventListener(key.slice(2), value);
    } else if (value === true) {
      element.setAttribute(key, '');
    } else if (value !== false && value !== null && value !== undefined) {
      element.setAttribute(key, String(value));
    }
  }
}

/**
 * @param {Element} element
 * @param {(Child | Child[])[]} children
 */
function append(element, children) {
  for (const child of children.flat()) {
    if (child !== null && child !== undefined && child !== false) {
      element.append(child instanceof Node ? child : document.createTextNode(String(child)));
    }
  }
}

/**
 * @param {string} tag
 * @param {Record<string, any>} attributes
 * @param {(Child | Child[])[]} children
 * @returns {HTMLElement}
 */
export function h(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  setAttributes(element, attributes);
  append(element, children);
  return element;
}

/**
 * The same for SVG.
 * @param {string} tag
 * @param {Record<string, any>} attributes
 * @param {(Child | Child[])[]} children
 * @returns {SVGElement}
 */
export function svg(tag, attributes = {}, ...children) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  setAttributes(element, attributes);
  append(element, children);
  return element;
}

/**
 * @param {Element} element
 * @param {(Child | Child[])[]} children
 */
export function fill(element, ...children) {
  element.replaceChildren();
  append(element, children);
}

/**
 * What has changed on the screen, under the hands of who uses it: the same link has the focus afterwards, and
 * what was scrolled stays so.
 * @param {Element} element
 * @param {(Child | Child[])[]} children
 */
export function refill(element, ...children) {
  const focused = document.activeElement;
  const href = element.contains(focused) ? focused?.getAttribute('href') : null;
  const scrolled = [...element.querySelectorAll('.scroll')].map((e) => [e.scrollLeft, e.scrollTop]);
  fill(element, ...children);
  element.querySelectorAll('.scroll').forEach((e, i) => {
    [e.scrollLeft, e.scrollTop] = scrolled[i] ?? [0, 0];
  });
  if (href) {
    const again = [...element.querySelectorAll('a')].find((a) => a.getAttribute('href') === href);
    again?.focus({ preventScroll: true });
  }
}

const icons = {
  play: 'M5 3l12 7-12 7z',
  pause: 'M4 3h4v14H4zM12 3h4v14h-4z',
  before: 'M14 4L5 10l9 6z',
  after: 'M6 4l9 6-9 6z',
  first: 'M4 4h2.500v12H4zM16 4l-8.500 6 8.500 6z',
  last: 'M13.500 4H16v12h-2.500zM4 4l8.500 6L4 16z',
};

/**
 * A picture for a button.
 * @param {keyof typeof icons} name
 */
export function icon(name) {
  return svg('svg', { viewBox: '0 0 20 20', width: 18, height: 18, 'aria-hidden': 'true' },
    svg('path', { d: icons[name], fill: 'currentColor' }));
}

/**
 * A button.
 * @param {string} label
 * @param {string | Node} content
 * @param {() => void} onclick
 */
export function button(label, content, onclick) {
  return h('button', { type: 'button', 'aria-label': label, title: label, onclick }, content);
}
