/** Colours, type and the few shapes that all panels share. */
import { css } from "lit";

export const theme = css`
  :host {
    --ink: #1d2730;
    --ink-soft: #55626d;
    --ink-faint: #66727c;
    --paper: rgb(252 252 250 / 0.93);
    --line: rgb(29 39 48 / 0.11);
    --hover: rgb(29 39 48 / 0.06);
    --accent: #a85a00;
    --accent-fill: #ff9e2c;
    --deep: #1f3a4d;
    --radius: 14px;
    --shadow: 0 1px 2px rgb(20 30 40 / 0.06), 0 8px 28px rgb(20 30 40 / 0.13);
    font: 400 14px/1.5 "Inter Variable", system-ui, sans-serif;
    font-feature-settings: "cv05", "ss03";
    color: var(--ink);
    -webkit-font-smoothing: antialiased;
  }
  *,
  *::before,
  *::after {
    box-sizing: border-box;
  }
  [hidden] {
    display: none !important;
  }
  h1,
  h2,
  h3,
  p,
  dl,
  dd,
  ul {
    margin: 0;
    padding: 0;
  }
  button {
    font: inherit;
    color: inherit;
    background: none;
    border: 0;
    padding: 0;
    cursor: pointer;
    -webkit-tap-highlight-color: transparent;
  }
  :focus-visible {
    outline: 2px solid var(--accent);
    outline-offset: 2px;
  }
  .sheet {
    background: var(--paper);
    backdrop-filter: blur(14px) saturate(1.3);
    border: 1px solid rgb(255 255 255 / 0.7);
    border-radius: var(--radius);
    box-shadow: var(--shadow);
  }
  .icon-button {
    display: inline-grid;
    place-items: center;
    width: 40px;
    height: 40px;
    border-radius: 10px;
    color: var(--ink-soft);
    transition:
      background 0.15s,
      color 0.15s;
  }
  .icon-button:hover {
    background: var(--hover);
    color: var(--ink);
  }
  .icon-button[aria-pressed="true"],
  .icon-button[aria-expanded="true"] {
    background: var(--deep);
    color: #fff;
  }
  .icon-button svg {
    width: 20px;
    height: 20px;
  }
  .eyebrow {
    font-size: 11px;
    font-weight: 600;
    letter-spacing: 0.07em;
    text-transform: uppercase;
    color: var(--ink-faint);
  }
  .swatch {
    flex: none;
    width: 12px;
    height: 12px;
    border-radius: 4px;
    box-shadow: inset 0 0 0 1px rgb(0 0 0 / 0.14);
  }
  kbd {
    font: 500 12px/1 "Inter Variable", system-ui, sans-serif;
    display: inline-block;
    min-width: 24px;
    padding: 5px 7px;
    text-align: center;
    white-space: nowrap;
    border: 1px solid var(--line);
    border-bottom-width: 2px;
    border-radius: 6px;
    background: #fff;
    color: var(--ink);
  }
  @media (prefers-reduced-motion: reduce) {
    * {
      transition: none !important;
      animation: none !important;
    }
  }
`;
