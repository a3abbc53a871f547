/** What the page does beside showing the place. Each says in words how it went; empty: nothing to say. */
import { faultOf } from "../core/fault.ts";
import type { Session } from "./session.ts";

export async function savePicture(session: Session): Promise<string> {
  try {
    const address = URL.createObjectURL(await session.viewer.screenshot());
    const link = document.createElement("a");
    link.href = address;
    link.download = `${session.place.parts[0]?.id ?? "veduta"}.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(address), 10_000);
    return "Picture saved";
  } catch (error) {
    return faultOf(error).message;
  }
}

export async function toggleFullscreen(): Promise<string> {
  try {
    if (document.fullscreenElement === null) await document.documentElement.requestFullscreen();
    else await document.exitFullscreen();
    return "";
  } catch (error) {
    if (!(error instanceof TypeError || error instanceof DOMException)) throw error;
    return "This browser does not allow full screen here";
  }
}
