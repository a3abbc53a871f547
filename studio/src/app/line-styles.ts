/** What panels of one line share: a name with a softer line under it, and a slider in the room left. */
import { css } from "lit";

export const lineStyles = css`
  strong {
    display: block;
    font-weight: 600;
    overflow: hidden;
    text-overflow: ellipsis;
    white-space: nowrap;
  }
  strong + span {
    color: var(--ink-soft);
    font-size: 13px;
    font-variant-numeric: tabular-nums;
    white-space: nowrap;
  }
  input[type="range"] {
    flex: 1;
    min-width: 60px;
    accent-color: var(--deep);
  }
`;
