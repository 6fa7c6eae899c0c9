/** Style of a stage. It colours nothing but the ring of the focus and messages: a drawing looks alike in every theme. */
export const STYLE = `
.vexture-stage {
  position: relative; max-width: 100%; overflow: hidden; cursor: grab; touch-action: none; user-select: none;
  outline-offset: -2px;
}
.vexture-stage:focus-visible { outline: 2px solid var(--jp-brand-color1, #1976d2); }
.vexture-stage.held, .vexture-stage.held canvas { cursor: grabbing !important; }
.vexture-stage canvas { display: block; width: 100%; height: 100%; }
.vexture-stage p:not([hidden]) { position: absolute; inset: auto 0 0; margin: 0; padding: 0.5em 1em; background: #fff; color: #b00020; }
`;
