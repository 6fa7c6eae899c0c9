/** Style of a stage. It colours nothing but the ring of the focus and messages: a drawing looks alike in every theme. */
export const STYLE = `
.vexture-stage {
  position: relative; max-width: 100%; overflow: hidden; cursor: grab; touch-action: none; user-select: none;
  outline-offset: -2px;
}
.vexture-stage:focus-visible { outline: 2px solid var(--jp-brand-color1, #1976d2); }
.vexture-stage.held, .vexture-stage.held canvas { cursor: grabbing !important; }
.vexture-stage canvas { display: block; width: 100%; height: 100%; }
.vexture-stage .vexture-legend, .vexture-stage .vexture-tip {
  position: absolute; margin: 0; padding: 8px 10px; border-radius: 4px; background: rgba(255, 255, 255, 0.92); color: #222;
  box-shadow: 0 1px 4px rgba(0, 0, 0, 0.3); font: 12px/1.4 system-ui, sans-serif; box-sizing: border-box;
}
.vexture-stage .vexture-legend {
  right: 10px; bottom: 10px; max-width: min(24em, 100% - 20px); max-height: calc(100% - 20px); overflow: auto; overscroll-behavior: contain;
  scrollbar-width: thin; cursor: default;
}
.vexture-stage:has(> .vexture-time:not([hidden])) .vexture-legend { bottom: 52px; max-height: calc(100% - 62px); }
.vexture-stage.low .vexture-legend, .vexture-stage.flat .vexture-time { display: none; }
.vexture-stage [hidden] { display: none !important; }
.vexture-stage .vexture-time {
  position: absolute; left: 10px; bottom: 10px; max-width: calc(100% - 20px); box-sizing: border-box; display: flex; align-items: center; gap: 8px; padding: 4px 10px 4px 4px; border-radius: 4px;
  background: rgba(255, 255, 255, 0.92); color: #222; box-shadow: 0 1px 4px rgba(0, 0, 0, 0.3); font: 12px/1.4 system-ui, sans-serif; cursor: default;
}
.vexture-time button { flex: none; width: 28px; height: 24px; padding: 0; border: 0; border-radius: 3px; background: transparent; color: inherit; cursor: pointer; }
.vexture-time button:hover { background: rgba(0, 0, 0, 0.08); }
.vexture-time input { flex: 0 1 180px; width: 180px; min-width: 60px; margin: 0; }
.vexture-time output { flex: 0 1 auto; min-width: 4em; white-space: nowrap; overflow: hidden; text-overflow: ellipsis; font-variant-numeric: tabular-nums; }
.vexture-legend summary { font-weight: 600; overflow-wrap: anywhere; cursor: pointer; list-style: none; }
.vexture-legend summary::after { content: '▸'; margin-left: 6px; color: #666; }
.vexture-legend[open] summary { margin-bottom: 4px; }
.vexture-legend[open] summary::after { content: '▾'; }
.vexture-legend summary:focus-visible { outline: 2px solid var(--jp-brand-color1, #1976d2); outline-offset: 2px; }
.vexture-legend .ramp { width: 160px; max-width: 100%; height: 12px; }
.vexture-legend .ends { display: flex; justify-content: space-between; }
.vexture-legend .entry { display: flex; align-items: center; gap: 6px; white-space: nowrap; }
.vexture-legend .entry span { overflow: hidden; text-overflow: ellipsis; }
.vexture-legend i { flex: none; box-sizing: border-box; width: 14px; height: 12px; border: 1px solid rgba(0, 0, 0, 0.2); }
.vexture-stage .vexture-tip:not([hidden]) {
  left: 0; top: 0; width: max-content; max-width: 60%; padding-block: 4px; display: grid; grid-template-columns: auto minmax(0, auto); gap: 0 10px;
  pointer-events: none;
}
.vexture-tip div { overflow-wrap: anywhere; }
.vexture-tip .name { max-width: 16em; color: #666; }
.vexture-stage p:not([hidden]) { position: absolute; inset: auto 0 0; max-height: 100%; overflow: auto; box-sizing: border-box; margin: 0; padding: 0.5em 1em; background: #fff; color: #b00020; }
`;
