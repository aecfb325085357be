'use strict';
// One scene: what it is, the table of its stages, the chosen row, the pictures.

class SceneView {
  /** `scene`: as html_report.cpp writes it, its view unpacked. `changed()`: as the viewer's. */
  constructor(scene, stages, changed) {
    const {view} = scene;
    this.rows = view.comparisons;
    this.first = scene.first === null ? null : this.rows[scene.first];
    this.details = element('div');
    this.table = new StageTable(this.rows, stages, this.first, (row) => this.choose(row));
    this.viewer = new Viewer(view, (viewer) => { this.follow(viewer); changed(viewer); });
    const failure = scene.failure.replace(/^ *repeat: .*\n?/m, '');  // it stands below, to be copied
    const said = failure ? element('pre', {className: 'bad'}, failure) : '';
    const lacks = !scene.color_alone ? '' : element('p', {className: 'quiet'},
      'In a page of many scenes, most of those that hold show their colour alone: checked alone, this one shows all.');
    this.host = element('div', {}, scene.description ? element('p', {}, scene.description) : '', said,
                        scene.repeat ? copied(scene.repeat) : '', lacks, this.viewer.host, element('h2', {}, 'stages'),
                        element('div', {className: 'judged'}, this.table.host, this.details));
    const told = this.rows.find((row) => ['failed', 'missing', 'different', 'dispute'].includes(row.outcome));
    const colour = view.layers.find((layer) => layer.name === 'colour');
    const start = this.first ?? told ?? (colour && rowOf(this.rows, colour, view.sides[1])) ?? this.rows[0];
    if (start) this.choose(start);
  }
  /** Chooses a row: shows its numbers, and in the viewer its layer, its side, its marks and its worst pixel. */
  choose(row) {
    const {view} = this.viewer;
    this.show(row);
    this.viewer.set({...this.marksOf(row), ...lookAt(view, row), centred: this.viewer.pixel === null,
                     pixel: this.viewer.pixel ?? worstOf(row)?.pixel ?? null});
  }
  show(row) {
    this.row = row;
    this.table.show(row);
    this.details.replaceChildren(rowDetails(row));
  }
  marksOf(row) {
    return {marks: row.mark === undefined ? null : this.viewer.view.marks[row.mark], judging: row.stage};
  }
  /** Shows the row of the viewer's layer and side, where the chosen row is about others. */
  follow({view, layer, against}) {
    const about = this.row && lookAt(view, this.row);
    const is = (side) => side === undefined || side === view.sides[against];
    if (!layer || !this.row || (is(about.against) && (!about.layer || layer.judged.includes(this.row.stage)))) return;
    const row = rowOf(this.rows, layer, view.sides[against]);
    if (!row || row === this.row) return;
    this.show(row);
    this.viewer.set(this.marksOf(row));
  }
  close() {
    this.viewer.close();
  }
}
