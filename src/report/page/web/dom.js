'use strict';

/** An element with its properties, attributes and children; text is never read as HTML. */
function element(tag, properties = {}, ...children) {
  const out = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in out) out[name] = value;
    else if (value !== false && value !== null) out.setAttribute(name, value);
  }
  out.append(...children.filter((child) => child !== null && child !== ''));
  return out;
}

/** Group of buttons of which one is pressed. A click calls `chosen(name)`; show(name) presses the button. */
class Choice {
  constructor(label, names, chosen) {
    this.buttons = new Map();
    this.host = element('div', {className: 'set', role: 'group', ariaLabel: label},
                        element('span', {className: 'quiet'}, label));
    for (const name of names) {
      const button = element('button', {type: 'button', onclick: () => chosen(name)}, name);
      this.buttons.set(name, button);
      this.host.append(button);
    }
  }
  show(name) {
    for (const [of, button] of this.buttons) button.setAttribute('aria-pressed', String(of === name));
  }
}

/** Button for the theme: the system's, light, or dark. The choice is kept where the browser lets a page store it. */
function themeButton() {
  const names = ['system', 'light', 'dark'];
  const button = element('button', {type: 'button', id: 'theme'});
  const show = (name) => {
    if (name === 'system') delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = name;
    button.textContent = `theme: ${name}`;
    button.value = name;
  };
  let kept = null;
  try {
    kept = localStorage.getItem('plumbline-theme');
  } catch { /* a page from a file may keep nothing */ }
  show(names.includes(kept) ? kept : 'system');
  button.onclick = () => {
    const next = names[(names.indexOf(button.value) + 1) % names.length];
    show(next);
    try {
      localStorage.setItem('plumbline-theme', next);
    } catch { /* likewise */ }
  };
  return button;
}

/** A text with a button that copies it. */
function copied(text) {
  const code = element('code', {}, text);
  const button = element('button', {type: 'button'}, 'copy');
  button.onclick = async () => {
    try {
      await navigator.clipboard.writeText(text);
      button.textContent = 'copied';
    } catch {  // no access to the clipboard: select the text, so that a key copies it
      getSelection().selectAllChildren(code);
      button.textContent = 'selected';
    }
    setTimeout(() => { button.textContent = 'copy'; }, 1500);
  };
  return element('div', {className: 'command'}, code, button);
}
