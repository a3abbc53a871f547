/** Draws the place and moves the camera through it, as the state says. */
import { type Object3D, PerspectiveCamera, Vector3, type WebGLRenderer } from "three";
import { worldFromDrawn } from "../core/frames.ts";
import { type Insets, NO_INSETS, shiftOf } from "../core/framing.ts";
import type { Hold } from "../core/input.ts";
import type { Place } from "../core/place.ts";
import type { Sight } from "../core/sight.ts";
import type { StudioState } from "../core/state.ts";
import type { Store } from "../core/store.ts";
import { add, subtract, type Vec3 } from "../core/vector.ts";
import type { Look } from "../core/view-link.ts";
import type { Walker } from "../core/walking.ts";
import { type Choice, choiceAt } from "./choosing.ts";
import { DrawLoop } from "./draw-loop.ts";
import type { Frusta } from "./frusta.ts";
import { Follower } from "./follower.ts";
import { Flight, type Pose, poseOf, setPose } from "./flight.ts";
import { Headset } from "./headset.ts";
import type { MorphShow, StrollCost } from "./morph-show.ts";
import { NEAR_M, OrbitRig } from "./orbit-rig.ts";
import type { ShownPhoto } from "./photo-show.ts";
import { Picker } from "./picker.ts";
import { CanvasPointer } from "./pointer.ts";
import { makeRenderer } from "./renderer.ts";
import { Screen } from "./screen.ts";
import { type Seen, seenBy, sightBy } from "./seen.ts";
import { Stage, type ViewerContent } from "./stage.ts";
import { Steering } from "./steering.ts";
import { TourGuide } from "./tour-guide.ts";
import type { Town } from "./town.ts";
import { WalkRig } from "./walk-rig.ts";

/** Radians per CSS pixel: a drag takes the picture along, the captured mouse turns the head. */
const DRAG_RAD_PX = 0.0032;
const MOUSE_RAD_PX = 0.0022;

export interface ViewerStats {
  readonly frames: number;
  readonly framesPerSecond: number;
  readonly triangles: number;
  /** Tiles that are drawn; 0 where the place is loaded whole. */
  readonly tiles: number;
}

export class Viewer {
  readonly #screen: Screen;
  readonly #store: Store<StudioState>;
  readonly #town: Town | null;
  readonly #frusta: Frusta | null;
  readonly #morphs: MorphShow | null;
  readonly headset: Headset | null;
  readonly #renderer: WebGLRenderer;
  readonly #stage: Stage;
  readonly #camera = new PerspectiveCamera(38, 1, NEAR_M, 6000);
  readonly #orbit: OrbitRig;
  readonly #walk: WalkRig;
  readonly #guide: TourGuide | null;
  readonly pointer: CanvasPointer;
  /** What is under a point of the canvas. */
  readonly picker: Picker;
  readonly #resizes: ResizeObserver;
  readonly #steering: Steering;
  #flight: Flight | null = null;
  #orbitPose: { pose: Pose; target: Vector3 } | null = null;
  readonly #follower: Follower;
  readonly #loop = new DrawLoop(
    (seconds) => this.#move(seconds),
    (sharpness) => {
      this.#screen.sharpen(sharpness);
      this.#draw();
    },
  );
  #frames = 0;
  /** Before that nothing is drawn: what is not compiled yet would hold up what is on its way. */
  #isPrepared = false;
  #insets: Insets = NO_INSETS;
  /** Called after each picture. */
  onDrawn: () => void = () => undefined;
  /** Called with what a click on the place means. */
  onChoice: (choice: Choice) => void = () => undefined;

  constructor(canvas: HTMLCanvasElement, place: Place, content: ViewerContent, store: Store<StudioState>) {
    const { town, frusta } = content;
    this.#store = store;
    this.#renderer = makeRenderer(canvas);
    this.#screen = new Screen(canvas, this.#renderer);
    this.#town = town;
    this.#frusta = frusta;
    this.#morphs = content.morphs;
    this.headset = content.morphs === null ? null : new Headset(this.#renderer, content.morphs, store, () => this.invalidate());
    this.#stage = new Stage(place, content, () => this.invalidate());
    const { solid } = this.#stage;
    const { min, max } = solid.bounds;
    this.#camera.far = Math.max(this.#camera.far, 3 * Math.hypot(max[0] - min[0], max[1] - min[1]));
    this.#orbit = new OrbitRig(this.#camera, canvas, this.#stage, () => this.invalidate());
    this.#orbit.enabled = store.value.morph === null;
    this.#walk = new WalkRig(place.start, solid, solid.bounds, this.#stage.body);
    this.#guide = place.tours.length === 0 ? null : new TourGuide(place.tours, store);
    this.#follower = new Follower(this.#orbit, this.#stage.animals);
    this.#steering = new Steering({ camera: this.#camera, walk: this.#walk, orbit: this.#orbit, guide: this.#guide }, store);
    this.picker = new Picker(canvas, this.#camera, solid, content, () => store.value);
    this.pointer = new CanvasPointer(canvas, {
      onClick: (x, y) => {
        const choice = choiceAt(x, y, this.picker, this.#stage.animals, store.value);
        if (choice !== null) this.onChoice(choice);
      },
      onLook: (dx, dy, captured) => this.#look(dx, dy, captured),
      onCapture: (captured) => store.update({ mouseLook: captured }),
    });
    this.#resizes = new ResizeObserver(() => this.#resize());
    this.#resizes.observe(canvas);
    store.subscribe((now, before) => this.#follow(now, before));
    this.#resize();
    this.#stage.appearance.tint(store.value);
    this.#stage.showLayers(store.value);
    this.#stage.light(store.value.hour);
    town?.show(store.value);
  }

  /** What one meets with. */
  get solid(): Stage["solid"] {
    return this.#stage.solid;
  }

  /** Compiles what is there already, or one thing of it, while the rest is on its way to the first picture. */
  warm(what: Object3D = this.#stage.scene): void {
    if (!this.#isPrepared) void this.#renderer.compileAsync(what, this.#camera, this.#stage.scene);
  }

  /** Compiles and draws once, so that the first picture the person sees is whole. */
  async prepare(): Promise<void> {
    this.goHome(); // what there is to see is known now
    await this.#town?.settle(this.#camera);
    const { morph } = this.#store.value;
    if (morph !== null) await this.#morphs?.settle(morph);
    await this.#renderer.compileAsync(this.#stage.scene, this.#camera);
    this.#isPrepared = true;
    this.#draw();
  }

  get walker(): Walker {
    return this.#walk.walker;
  }

  /** What goes on in the houses of the place. */
  get household(): Stage["household"] {
    return this.#stage.household;
  }

  /** What lives in the place. */
  get animals(): Stage["animals"] {
    return this.#stage.animals;
  }

  /** The model of a part has come. */
  take(part: number): void {
    this.#stage.take(part, this.#store.value);
    this.#walk.body = this.#stage.body;
    this.invalidate();
  }

  /** Clouds of points have come. */
  takeClouds(): void {
    this.#stage.takeClouds(this.#store.value);
    this.invalidate();
  }

  /** The browser has given the graphics card back: everything goes there again. */
  restore(): void {
    this.#stage.showLayers(this.#store.value);
    this.invalidate();
  }

  /** Puts the walker at the first of these places (feet) where nothing is in the way. */
  goTo(places: readonly Vec3[]): void {
    if (!this.#walk.goTo(places)) return;
    this.#guide?.stop();
    setPose(this.#camera, this.#walk.pose(this.#camera));
    this.invalidate();
  }

  get isFlying(): boolean {
    return this.#flight !== null;
  }

  get stats(): ViewerStats {
    return {
      frames: this.#frames,
      framesPerSecond: this.#loop.framesPerSecond,
      triangles: this.solid.faceCount,
      tiles: this.#town?.tileCount ?? 0,
    };
  }

  /** Of the walk from view to view that one is on. */
  get strollCost(): StrollCost | null {
    const { morph } = this.#store.value;
    return morph === null ? null : (this.#morphs?.cost(morph.which) ?? null);
  }

  /** The photos that lie on the place, and how far each has faded in. */
  get shownPhotos(): readonly ShownPhoto[] {
    return this.#stage.photos?.shown ?? [];
  }

  /** The photo that is most as one sees now. */
  get nearestPhoto(): number | null {
    return this.#stage.photos?.nearest(this.pose) ?? null;
  }

  /** World frame. */
  get pose(): Seen {
    return seenBy(this.#drawnBy);
  }

  get #drawnBy(): PerspectiveCamera {
    return (this.#store.value.morph === null ? null : this.#morphs?.camera) ?? this.#camera;
  }

  /** What is seen now; null before the first picture. */
  get sight(): Sight | null {
    return this.#isPrepared ? sightBy(this.#drawnBy) : null;
  }

  /** Where one stands and looks to: around which one turns, or straight ahead. */
  get look(): Look {
    const { eye, direction } = this.pose;
    const isOrbit = this.#store.value.mode === "orbit";
    return { eye, target: isOrbit ? worldFromDrawn(this.#orbit.target.toArray()) : add(eye, direction) };
  }

  /** At once. */
  lookFrom({ eye, target }: Look): void {
    this.#flight = null;
    if (this.#store.value.mode === "walk") {
      this.#walk.place(eye, subtract(target, eye));
      setPose(this.#camera, this.#walk.pose(this.#camera));
    } else {
      this.#orbit.lookFrom(eye, target, this.#insets);
    }
    this.invalidate();
  }

  hold(key: Hold, down: boolean): void {
    if (this.#steering.hold(key, down) || down) this.invalidate();
  }

  releaseKeys(): void {
    this.#steering.release();
  }

  /** x right, y forward, -1..1. */
  setStick(x: number, y: number): void {
    this.#steering.setStick(x, y);
    this.invalidate();
  }

  /** What lies over the picture; the next reset leaves it free. */
  setInsets(insets: Insets): void {
    this.#insets = insets;
  }

  /** Moves the picture so that its middle is the free part's middle. */
  recentre(): void {
    if (this.#store.value.mode !== "orbit") return;
    this.#fly({ ...poseOf(this.#camera), shift: shiftOf(this.#insets) });
  }

  resetView(): void {
    this.#morphs?.lookAhead();
    this.invalidate();
    if (this.#store.value.morph !== null) return;
    if (this.#store.value.shot !== null) {
      this.#orbitPose = null;
      this.#store.update({ shot: null });
      return;
    }
    if (this.#store.value.mode === "walk") {
      this.#guide?.stop();
      this.#walk.restart();
      this.#fly(this.#walk.pose(this.#camera));
      return;
    }
    const home = this.#home();
    this.#orbit.aimAt(home.target);
    this.#fly(home.pose);
  }

  async screenshot(): Promise<Blob> {
    this.#draw();
    return await this.#screen.picture();
  }

  dispose(): void {
    this.#stage.dispose();
    void this.headset?.leave();
    this.#loop.stop();
    this.#resizes.disconnect();
    this.pointer.dispose();
    this.#orbit.dispose();
    this.#renderer.dispose();
  }

  /** Asks for a frame; nothing is drawn while nothing changes. */
  invalidate(): void {
    if (this.#isPrepared && this.headset?.isOn !== true) this.#loop.ask();
  }

  #move(seconds: number): boolean {
    const moves = [
      this.#advance(seconds),
      this.#stage.advance(this.#store.value, this.walker, this.pose.eye, Math.min(seconds, 0.1)),
      this.#stage.fade(this.#store.value, this.pose, Math.min(seconds, 0.1)),
    ];
    this.#follower.follow(this.#store.value);
    return moves.includes(true);
  }

  #advance(seconds: number): boolean {
    const { morph } = this.#store.value;
    if (morph !== null && this.#morphs !== null) {
      const { wish, turn } = this.#steering;
      const next = this.#morphs.advance(morph, wish, turn, Math.min(seconds, 0.1));
      if (next !== null) this.#store.update({ morph: next });
      return next !== null;
    }
    if (this.#flight !== null) {
      if (this.#flight.advance(this.#camera, Math.min(seconds, 0.35))) this.#flight = null;
      return true;
    }
    return this.#steering.advance(seconds);
  }

  #draw(): void {
    const { morph } = this.#store.value;
    if (morph !== null && this.#morphs !== null) {
      this.#morphs.draw(this.#renderer, morph);
    } else {
      this.#orbit.keepDepth(this.#store.value.mode);
      if (this.#stage.update(this.#camera, this.#renderer)) this.invalidate();
      this.#stage.draw(this.#renderer, this.#camera, this.#store.value);
      this.#stage.photos?.draw(this.#renderer, this.#camera, this.#stage.canvas, this.#store.value.shot !== null);
    }
    this.#frames += 1;
    this.onDrawn();
  }

  #follow(now: StudioState, before: StudioState): void {
    if (now.tour !== before.tour) this.#goOnTour(now, before);
    if (now.mode !== before.mode) this.#changeMode(now.mode);
    if ((now.morph === null) !== (before.morph === null)) this.#orbit.enabled = now.morph === null && now.mode === "orbit";
    if (now.shot !== before.shot) this.#lookThrough(now.shot, before.shot);
    const shows = now.hidden !== before.hidden || now.off !== before.off || now.point_px !== before.point_px;
    if (shows || now.shot !== before.shot) this.#stage.showLayers(now);
    if (now.hour !== before.hour) this.#stage.light(now.hour);
    if (this.#town !== null) this.#town.show(now);
    if (now.selected !== before.selected) this.#stage.outline(now.selected);
    if (now.selected !== before.selected || now.colouring !== before.colouring) {
      this.#stage.appearance.tint(now);
    }
    this.invalidate();
  }

  /** To where the person wants the tour to go on; whoever leaves it stays where he is. */
  #goOnTour(now: StudioState, before: StudioState): void {
    const view = this.#guide?.wished(now.tour) ?? null;
    if (view === null) return;
    this.#walk.place(view.eye, view.direction);
    if (now.mode !== "walk" || before.mode !== "walk") return; // the change of mode flies there
    if (now.tour?.playing === true) this.#fly(this.#walk.pose(this.#camera));
    else setPose(this.#camera, this.#walk.pose(this.#camera));
  }

  #changeMode(mode: StudioState["mode"]): void {
    this.#steering.release();
    this.#orbit.enabled = mode === "orbit";
    if (mode === "walk") {
      this.#walk.begin();
      this.#orbitPose = { pose: poseOf(this.#camera), target: this.#orbit.target.clone() };
      this.#fly(this.#walk.pose(this.#camera));
      return;
    }
    this.#guide?.stop();
    this.pointer.release();
    this.#returnToOrbit();
  }

  /** Flies to where a photo was taken, and back to where the person was before. */
  #lookThrough(shot: number | null, before: number | null): void {
    if (shot !== null) this.#guide?.stop();
    void this.#frusta?.show(shot);
    this.#orbit.enabled = shot === null && this.#store.value.mode === "orbit";
    if (before === null && this.#store.value.mode === "orbit") {
      this.#orbitPose = { pose: poseOf(this.#camera), target: this.#orbit.target.clone() };
    }
    const seen = shot === null ? null : (this.#frusta?.poseOf(shot, this.#camera) ?? null);
    if (seen !== null) this.#fly(seen);
    else if (this.#store.value.mode === "walk") this.#fly(this.#walk.pose(this.#camera));
    else this.#returnToOrbit();
  }

  #returnToOrbit(): void {
    const back = this.#orbitPose ?? this.#home();
    this.#orbit.aimAt(back.target);
    this.#fly(back.pose);
  }

  #fly(to: Pose): void {
    this.#flight = new Flight(poseOf(this.#camera), to);
    this.invalidate();
  }

  #home(): { pose: Pose; target: Vector3 } {
    return this.#orbit.home(this.#camera.aspect, this.#insets);
  }

  /** At once, as it is at the beginning. */
  goHome(): void {
    const home = this.#home();
    this.#orbit.aimAt(home.target);
    setPose(this.#camera, home.pose);
    this.#orbit.advance();
    this.invalidate();
  }

  #look(dx: number, dy: number, captured: boolean): void {
    if (this.#store.value.morph !== null) {
      const turn = captured ? -MOUSE_RAD_PX : DRAG_RAD_PX / 2;
      this.#morphs?.look(dx * turn, dy * turn);
      this.invalidate();
      return;
    }
    if (this.#store.value.mode !== "walk" || this.#flight !== null) return;
    this.#guide?.stop();
    const scale = captured ? -MOUSE_RAD_PX : DRAG_RAD_PX;
    this.#walk.turn(dx * scale, dy * scale);
    this.invalidate();
  }

  #resize(): void {
    const size = this.#screen.resize();
    if (size === null) return;
    this.#stage.appearance.outline.resize(size.width, size.height);
    this.#camera.aspect = size.width / size.height;
    setPose(this.#camera, poseOf(this.#camera));
    this.invalidate();
  }
}
