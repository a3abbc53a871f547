/** Where things are on the page: wide, and upright on a phone. */
import { css } from "lit";

export const studioStyles = css`
  :host {
    position: fixed;
    inset: 0;
    overflow: hidden;
    --edge: 16px;
  }
  main {
    display: contents;
  }
  canvas {
    position: absolute;
    inset: 0;
    width: 100%;
    height: 100%;
    display: block;
    touch-action: none;
    outline-offset: -3px !important;
    cursor: grab;
  }
  canvas:active {
    cursor: grabbing;
  }
  .brand {
    position: absolute;
    top: var(--edge);
    left: var(--edge);
    display: flex;
    align-items: center;
    gap: 10px;
    width: 252px;
    padding: 10px 14px 10px 11px;
  }
  .brand img {
    display: block;
    flex: none;
  }
  .brand div {
    min-width: 0;
    line-height: 1.25;
  }
  .brand strong {
    display: block;
    font-weight: 640;
    letter-spacing: -0.01em;
  }
  .brand span {
    display: block;
    font-size: 12.5px;
    color: var(--ink-soft);
    white-space: nowrap;
    overflow: hidden;
    text-overflow: ellipsis;
  }
  .left {
    position: absolute;
    top: calc(var(--edge) + 66px);
    left: var(--edge);
    width: 252px;
    max-height: calc(100% - 2 * var(--edge) - 66px - 70px);
    display: flex;
    flex-direction: column;
    gap: 10px;
  }
  .left > .sheet {
    overflow: auto;
    scrollbar-width: thin;
    min-height: 120px;
  }
  .left > veduta-photo-list {
    flex: 1 1 300px;
    min-height: 140px;
    overflow: hidden;
  }
  veduta-toolbar {
    position: absolute;
    bottom: var(--edge);
    left: 50%;
    transform: translateX(-50%);
  }
  veduta-feature-panel {
    position: absolute;
    top: var(--edge);
    right: var(--edge);
    width: 328px;
    max-height: calc(100% - 2 * var(--edge));
  }
  veduta-minimap {
    position: absolute;
    right: var(--edge);
    bottom: var(--edge);
    width: 232px;
  }
  veduta-photo-panel {
    position: absolute;
    top: var(--edge);
    left: 50%;
    transform: translateX(-50%);
    width: max-content;
    max-width: calc(100% - 2 * var(--edge) - 540px);
    min-width: 300px;
  }
  veduta-animal-panel.over-tour {
    bottom: calc(var(--edge) + 118px);
  }
  veduta-tour-panel,
  veduta-animal-panel,
  veduta-morph-panel {
    position: absolute;
    bottom: calc(var(--edge) + 60px);
    left: 50%;
    transform: translateX(-50%);
    width: 500px;
    max-width: calc(100% - 2 * var(--edge));
    box-sizing: border-box;
  }
  .hint.over-tour {
    bottom: calc(var(--edge) + 120px);
  }
  .hint {
    position: absolute;
    left: 50%;
    bottom: calc(var(--edge) + 62px);
    transform: translateX(-50%);
    padding: 4px 12px;
    border-radius: 99px;
    font-size: 12.5px;
    white-space: nowrap;
    color: #24313b;
    background: rgb(252 252 250 / 0.72);
    pointer-events: none;
    animation: leave 1s 9s forwards;
  }
  @keyframes leave {
    to {
      opacity: 0;
    }
  }
  .crosshair {
    position: absolute;
    left: 50%;
    top: 50%;
    width: 8px;
    height: 8px;
    margin: -4px;
    border-radius: 50%;
    border: 2px solid #fff;
    box-shadow: 0 0 0 1px rgb(0 0 0 / 0.35);
    pointer-events: none;
  }
  veduta-joystick {
    position: absolute;
    left: calc(var(--edge) + 8px);
    bottom: calc(var(--edge) + 84px);
  }
  @media (max-width: 1080px) {
    /* Beside the tools there is no room for it. */
    veduta-minimap {
      bottom: calc(var(--edge) + 66px);
    }
    veduta-minimap.over-tour {
      bottom: calc(var(--edge) + 124px);
    }
  }
  @media (max-width: 720px) {
    :host {
      --edge: max(10px, env(safe-area-inset-bottom));
    }
    .brand {
      width: auto;
      max-width: calc(100% - 2 * var(--edge));
    }
    veduta-photo-panel {
      top: calc(var(--edge) + 62px);
      max-width: calc(100% - 2 * var(--edge));
    }
    .left {
      top: calc(var(--edge) + 62px);
      width: min(264px, calc(100% - 2 * var(--edge)));
      max-height: calc(100% - 2 * var(--edge) - 62px - 100px);
    }
    veduta-minimap {
      bottom: calc(var(--edge) + 84px);
      width: 150px;
      --map-height: 110px;
    }
    veduta-minimap.over-tour,
    veduta-joystick.over-tour {
      bottom: calc(var(--edge) + 144px);
    }
    veduta-feature-panel:not([hidden]) ~ veduta-minimap {
      display: none;
    }
    veduta-feature-panel {
      top: auto;
      bottom: calc(var(--edge) + 60px);
      left: var(--edge);
      right: var(--edge);
      width: auto;
      max-height: 48%;
    }
  }
`;
