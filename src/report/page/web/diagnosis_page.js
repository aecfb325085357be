'use strict';
// The page of plumb diagnose: one scene, in one or two views.

const diagnosis = JSON.parse(document.getElementById('diagnosis').textContent);

async function show() {
  document.getElementById('tools').append(themeButton());
  const host = document.getElementById('views');
  for (const {first, view: packed} of diagnosis.views) {
    const view = await unpackedView(packed);
    const scene = {description: '', failure: '', repeat: '', first, view};
    host.append(element('h2', {}, view.title), new SceneView(scene, diagnosis.stages, () => {}).host);
  }
}

show();
