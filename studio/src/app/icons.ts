/** Line icons on a 24 by 24 grid, drawn for this studio. */
import { svg, type TemplateResult } from "lit";

function icon(paths: TemplateResult): TemplateResult {
  return svg`<svg viewBox="0 0 24 24" fill="none" stroke="currentColor" stroke-width="1.7"
    stroke-linecap="round" stroke-linejoin="round" aria-hidden="true">${paths}</svg>`;
}

export const icons = {
  orbit: icon(svg`<path d="M12 4.5 19 8v8l-7 3.5L5 16V8z"/><path d="M5 8l7 3.5L19 8M12 11.5v8"/>`),
  walk: icon(svg`<circle cx="13" cy="4.6" r="1.7"/><path d="M9 21l2.4-5.2L9.6 13l1.2-5 3.4 1.2 1.6 2.6 2.4.8M10.8 8 7.8 9.8 7 13M11.4 15.6 14 17.4l1 3.6"/>`),
  reset: icon(svg`<path d="M4.5 11 12 5l7.5 6"/><path d="M6.5 10v8.5h11V10"/><path d="M10.5 18.5v-5h3v5"/>`),
  layers: icon(svg`<path d="M12 4 4 8.3l8 4.2 8-4.2z"/><path d="M4 12.2l8 4.2 8-4.2M4 16l8 4.2 8-4.2"/>`),
  camera: icon(svg`<path d="M4 8.5h3.4l1.5-2.3h6.2l1.5 2.3H20v10H4z"/><circle cx="12" cy="13.2" r="3.2"/>`),
  fullscreen: icon(svg`<path d="M4.5 9V4.5H9M15 4.5h4.5V9M19.5 15v4.5H15M9 19.5H4.5V15"/>`),
  help: icon(svg`<circle cx="12" cy="12" r="8.2"/><path d="M9.7 9.6a2.4 2.4 0 1 1 3.4 2.5c-.8.4-1.1.9-1.1 1.7"/><path d="M12 16.4v.1"/>`),
  mouse: icon(svg`<rect x="7" y="3.8" width="10" height="16.4" rx="5"/><path d="M12 7.4v3"/>`),
  sun: icon(svg`<circle cx="12" cy="12" r="3.8"/><path d="M12 3.5v2.2M12 18.3v2.2M3.5 12h2.2M18.3 12h2.2M6 6l1.5 1.5M16.5 16.5 18 18M18 6l-1.5 1.5M7.5 16.5 6 18"/>`),
  moon: icon(svg`<path d="M19.5 14.2A8 8 0 0 1 9.8 4.5a8 8 0 1 0 9.7 9.7z"/>`),
  close: icon(svg`<path d="M6.5 6.5l11 11M17.5 6.5l-11 11"/>`),
  eye: icon(svg`<path d="M3 12s3.3-5.6 9-5.6 9 5.6 9 5.6-3.3 5.6-9 5.6S3 12 3 12z"/><circle cx="12" cy="12" r="2.5"/>`),
  eyeOff: icon(svg`<path d="M4 4l16 16"/><path d="M9.6 6.7A9.4 9.4 0 0 1 12 6.4c5.7 0 9 5.6 9 5.6a16 16 0 0 1-2.6 3.2M6.3 8A15.5 15.5 0 0 0 3 12s3.3 5.6 9 5.6c1.2 0 2.3-.25 3.3-.65"/>`),
  projector: icon(svg`<path d="M3.5 9.5h9v7h-9z"/><circle cx="8" cy="13" r="1.6"/><path d="M12.5 11.5 20.5 7v12l-8-4.5"/>`),
  play: icon(svg`<path d="M8 5.5v13l10.5-6.5z"/>`),
  pause: icon(svg`<path d="M8.5 6v12M15.5 6v12"/>`),
  chevron: icon(svg`<path d="M9.5 6l6 6-6 6"/>`),
};
