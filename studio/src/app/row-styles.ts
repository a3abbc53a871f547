/** Rows of a panel's list: switches, layers, sliders. */
import { css } from "lit";

export const rowStyles = css`
  ul {
    list-style: none;
  }
  .row {
    display: flex;
    align-items: center;
    gap: 10px;
    width: 100%;
    min-height: 36px;
    padding: 6px 8px;
    border-radius: 8px;
    text-align: left;
  }
  button.row:hover {
    background: var(--hover);
  }
  .row .name {
    flex: 1;
  }
  .row svg {
    width: 18px;
    height: 18px;
    color: var(--ink-faint);
  }
  .row[aria-checked="false"] .name {
    color: var(--ink-faint);
  }
  .row[aria-checked="false"] .hides {
    text-decoration: line-through;
    text-decoration-thickness: 1px;
  }
  label.row {
    color: var(--ink-soft);
  }
  .row input {
    flex: 1;
    min-width: 0;
    accent-color: var(--deep);
  }
  .knob {
    flex: none;
    width: 30px;
    height: 18px;
    padding: 2px;
    border-radius: 9px;
    background: #b9c0c5;
    transition: background 0.15s;
  }
  .knob::after {
    content: "";
    display: block;
    width: 14px;
    height: 14px;
    border-radius: 50%;
    background: #fff;
    transition: transform 0.15s;
  }
  [aria-checked="true"] > .knob {
    background: var(--deep);
  }
  [aria-checked="true"] > .knob::after {
    transform: translateX(12px);
  }
  .segments {
    display: grid;
    grid-auto-flow: column;
    grid-auto-columns: auto;
    gap: 2px;
    padding: 3px;
    border-radius: 10px;
    background: var(--hover);
  }
  .segments button {
    padding: 6px 10px;
    border-radius: 8px;
    font-size: 13px;
    font-weight: 520;
    color: var(--ink-soft);
  }
  .segments button[aria-checked="true"] {
    background: #fff;
    color: var(--ink);
    box-shadow: 0 1px 3px rgb(20 30 40 / 0.16);
  }
`;
