// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The picture: a GLB of tenon, the camera, and what is laid over it. Draws only when something has
// changed. Where the graphics are drawn by software, edges are not smoothed.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { MeshoptDecoder } from "three/examples/jsm/libs/meshopt_decoder.module.js";
import { Batches, batched } from "./batches";
import { Eye, type Side, sides, usualAngle } from "./eye";
import { fitted } from "./framing";
import { dispose, openGraphics, sizeOf } from "./graphics";
import { gridLines } from "./grid";
import { GroundShadow } from "./ground_shadow";
import { type BodyInfo, type CameraInfo, type NodeKind, type SceneInfo, noScene } from "./info";
import { addLights, keepForm } from "./lights";
import { Marks } from "./marks";
import { Motion } from "./motion";
import { Overlays, type OverlayName } from "./overlays";
import { Pace } from "./pace";
import { completeSurfaces } from "./surfaces";
import { type Part, Visibility } from "./visibility";

const themes = {
  light: { background: 0xeef1f4, grid: 0xb9c2cb, axis: 0x8793a0 },
  dark: { background: 0x16191d, grid: 0x343b43, axis: 0x5a6570 },
};

const highlight = new THREE.Color(0x2f7fe0);
const failure = new THREE.Color(0xe02f2f);

export interface ViewerOptions {
  /** Smooths edges; as the machine is fast enough for, unless said. */
  antialias?: boolean;
  /** What is behind the scene may show through. */
  alpha?: boolean;
  /** Draws when something has changed; else when `draw` is called. */
  animated?: boolean;
}

export class Viewer extends EventTarget {
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(usualAngle, 1, 0.001, 1000);
  readonly renderer: THREE.WebGLRenderer;
  readonly controls: OrbitControls;
  readonly software: boolean;
  readonly overlays = new Overlays(this);
  readonly visibility = new Visibility();
  readonly eye: Eye;
  info: SceneInfo = noScene;
  /** What stands in the world's axes: its children are the bodies and the world's own node. */
  root: THREE.Object3D = new THREE.Group();
  /** Nodes of the bodies, in order. */
  bodies: THREE.Object3D[] = [];
  /** The baked motion; null: none. */
  motion: Motion | null = null;
  /** Middle and size of the scene, in glTF's axes [m]. */
  readonly sphere = new THREE.Sphere(new THREE.Vector3(), 1);
  selected = "";
  /** Further prims that are selected beside it. */
  readonly also = new Set<string>();
  /** The body that the camera goes along with; "": none. */
  followed = "";
  /** The prim that a failed simulation names; "": none. */
  failed = "";
  /** What the view is fitted to: all that is drawn, but for grounds. */
  fitted: THREE.Object3D[] = [];

  private readonly marks = new Marks();
  private readonly pace = new Pace();
  private readonly batches = new Batches(this.scene);
  private readonly shadow = new GroundShadow();
  private readonly grid = new THREE.Group();
  private readonly kinds: Record<NodeKind, THREE.Object3D[]> = {
    world: [],
    body: [],
    visual: [],
    collider: [],
  };
  private readonly animated: boolean;
  private ratio = 1;
  private dirty = true;
  private sized = false;
  private frames = 0;
  private scenes = 0;
  private theme: keyof typeof themes = "light";

  constructor(
    readonly container: HTMLElement,
    { antialias, alpha = false, animated = true }: ViewerOptions = {},
  ) {
    super();
    this.animated = animated;
    const graphics = openGraphics(antialias, sizeOf(container));
    this.software = graphics.software;
    this.renderer = new THREE.WebGLRenderer({
      canvas: graphics.canvas,
      context: graphics.context ?? undefined,
      alpha,
    });
    this.setPixelRatio(this.software ? 1 : Math.min(devicePixelRatio, 2));
    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", "The asset in three dimensions");
    container.append(canvas);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => {
      this.eye.leave(); // the mouse takes over
      this.invalidate();
      this.dispatchEvent(new Event("camera"));
    });
    this.eye = new Eye(this.camera, this.controls);
    addLights(this.scene, this.camera);
    keepForm(this.renderer);
    this.scene.add(this.grid);
    this.grid.add(this.shadow.mesh);
    this.setTheme("light");
    this.listenToPointer(canvas);
    new ResizeObserver(() => this.resize()).observe(container);
    this.resize();
    if (animated) {
      this.renderer.setAnimationLoop((time) => this.tick(time / 1000));
    }
  }

  /** Pixels for each of the page, along each side. */
  setPixelRatio(ratio: number): void {
    this.ratio = ratio;
    this.renderer.setPixelRatio(ratio);
  }

  /** Shows another file; the camera stays where it is with `keepCamera`. */
  async load(bytes: ArrayBuffer, keepCamera = false): Promise<void> {
    const loader = new GLTFLoader();
    loader.setMeshoptDecoder(MeshoptDecoder);
    const file = await loader.parseAsync(bytes, "");
    await completeSurfaces(file);
    this.clear();
    this.scene.add(file.scene);
    this.root = file.scene.children[0] ?? file.scene;
    this.info = { ...noScene, ...(file.scene.userData.tenon as Partial<SceneInfo> | undefined) };
    file.scene.traverse((node) => {
      const kind = node.userData.kind as NodeKind | undefined;
      if (kind && kind in this.kinds) {
        this.kinds[kind].push(node);
        if (kind === "body") {
          this.bodies[node.userData.index as number] = node;
        }
      }
    });
    this.prepareColliders();
    this.motion = file.animations.length > 0 ? new Motion(file.scene, file.animations[0]!) : null;
    this.measure();
    this.makeGrid();
    this.shadow.begin(this.fitted, this.sphere.radius);
    const through = this.info.cameras.find(({ path }) => path === this.eye.through?.path);
    through ? (this.eye.through = through) : this.eye.leave();
    this.stand();
    if (!keepCamera) {
      this.frame();
    }
    this.overlays.rebuild();
    this.batches.begin(this.kinds.visual);
    this.visibility.begin(this.parts(), this.info.bodies.map((body) => body.path));
    this.showSelection();
    this.scenes += 1;
    this.dispatchEvent(new Event("load"));
    this.invalidate();
  }

  /** Places all bodies: time [s], then x y z qx qy qz qw of each in the world's axes. */
  setPoses(frame: Float32Array): void {
    for (let i = 0; i < this.bodies.length; ++i) {
      const at = 1 + 7 * i;
      this.bodies[i]?.position.fromArray(frame, at);
      this.bodies[i]?.quaternion.fromArray(frame, at + 3);
    }
    this.moved();
    this.invalidate();
  }

  /** The camera goes along with a body; "" leaves it where it is. */
  follow(path: string): void {
    this.followed = path;
    path && this.eye.leave();
    this.eye.moveWith(null);
    this.moved();
    this.dispatchEvent(new Event("camera"));
  }

  /** Looks through a camera of the asset, wherever that goes; null: no longer. */
  lookThrough(camera: CameraInfo | null): void {
    this.follow("");
    camera ? (this.eye.orthographic = false) : this.eye.leave();
    this.eye.through = camera;
    this.stand();
    this.invalidate();
    this.dispatchEvent(new Event("camera"));
  }

  private stand(): void {
    this.eye.stand(this.bodies[this.eye.through?.body ?? -1] ?? this.root, this.sphere);
  }

  /** After bodies were placed. */
  moved(): void {
    this.shadow.stale = true;
    this.overlays.follow();
    const body = this.bodies[this.info.bodies.findIndex((one) => one.path === this.followed)];
    this.eye.moveWith(body ? body.getWorldPosition(new THREE.Vector3()) : null);
    this.stand();
    this.dispatchEvent(new Event("poses"));
  }

  /** The object of a path: a body, or a visual or collider by its own. */
  nodeAt(path: string): THREE.Object3D | undefined {
    return this.nodes().find((node) => node.userData.path === path);
  }

  /** Selects a prim by its path; "" selects nothing. */
  select(path: string): void {
    this.also.clear();
    this.selected = path;
    this.showSelection();
    this.dispatchEvent(new CustomEvent("select", { detail: path }));
  }

  /** Selects a prim beside those that are selected, or takes it off. */
  selectAlso(path: string): void {
    const all = this.selection();
    const left = all.includes(path) ? all.filter((one) => one !== path) : [path, ...all];
    this.select(left[0] ?? "");
    left.slice(1).forEach((one) => this.also.add(one));
    this.showSelection();
    this.dispatchEvent(new CustomEvent("select", { detail: this.selected }));
  }

  /** All that is selected, what was selected last first. */
  selection(): string[] {
    return this.selected ? [this.selected, ...this.also] : [];
  }

  /** Marks the prim that a failed simulation names; "" takes the mark off. */
  markFailed(path: string): void {
    this.failed = path;
    this.showSelection();
  }

  private showSelection(): void {
    this.marks.clear();
    const marks = [
      [this.failed, failure] as const,
      ...this.selection().map((path) => [path, highlight] as const),
    ];
    for (const [path, color] of marks) {
      const node = path ? this.nodeAt(path) : undefined;
      if (node) {
        this.marks.add(node, color);
      }
    }
    this.overlays.selectionChanged();
    this.invalidate();
  }

  /** Whether there is anything of a kind. */
  has(kind: NodeKind): boolean {
    return this.kinds[kind].length > 0;
  }

  show(kind: "visual" | "collider", visible: boolean): void {
    this.change(() => this.visibility.show(kind, visible));
  }

  /** Changes what is drawn of the parts; materials of the selection stay marked. */
  change(act: () => void): void {
    this.marks.clear();
    act();
    this.shadow.stale = true;
    this.showSelection();
    this.dispatchEvent(new Event("visibility"));
  }

  showOverlay(name: OverlayName, visible: boolean): void {
    this.overlays.show(name, visible);
    this.invalidate();
  }

  showGrid(visible: boolean): void {
    this.grid.visible = visible;
    this.invalidate();
  }

  setTheme(theme: "light" | "dark"): void {
    this.theme = theme;
    this.scene.background = new THREE.Color(themes[theme].background);
    this.makeGrid();
    this.invalidate();
  }

  /** Looks at a prim, or at everything, from a direction: where one sees it best, unless said. */
  frame(path = "", from = new THREE.Vector3(1, 0.55, 1.1), zoom = 1): void {
    this.eye.leave();
    const sphere = this.sphere.clone();
    const node = path ? this.nodeAt(path) : undefined;
    const box = node ? new THREE.Box3().setFromObject(node) : new THREE.Box3();
    if (!box.isEmpty()) {
      box.getBoundingSphere(sphere);
    }
    const away = from.clone().normalize();
    const half = THREE.MathUtils.degToRad(this.camera.fov / 2);
    const narrow = Math.min(1, this.camera.aspect);
    const distance = ((sphere.radius / Math.sin(half) / narrow) * 1.02) / zoom;
    this.lookAs(sphere.center.clone().addScaledVector(away, distance), sphere.center);
  }

  /** Looks from a place at another one, in glTF's axes [m]. */
  lookAs(place: THREE.Vector3, target: THREE.Vector3): void {
    this.eye.leave();
    const distance = place.distanceTo(target);
    this.camera.position.copy(place);
    this.camera.near = distance / 500;
    this.camera.far = Math.max(distance, this.sphere.radius) * 50;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(target);
    this.controls.update();
    this.invalidate();
  }

  /** Looks at what is looked at from a side, along an axis of the asset. */
  lookFrom(side: Side): void {
    const away = new THREE.Vector3(...sides[side]).applyQuaternion(this.root.quaternion);
    const path = this.nodeAt(this.selected) ? this.selected : "";
    this.frame(path, away);
  }

  setOrthographic(on: boolean): void {
    on && this.eye.leave();
    this.eye.orthographic = on;
    this.invalidate();
    this.dispatchEvent(new Event("camera"));
  }

  /** Draws again before the next picture. */
  invalidate(): void {
    this.dirty = true;
  }

  /** How many scenes were shown so far. */
  get shown(): number {
    return this.scenes;
  }

  /** How many pictures were drawn so far. */
  get drawn(): number {
    return this.frames;
  }

  /** Draws now, with all pixels. */
  draw(): void {
    this.pace.fine();
    this.drawAs(1);
  }

  /** Whether there is time for the shadow. The first picture comes without. */
  private get inTime(): boolean {
    return this.pace.share === 1 && (this.frames > 0 || !this.animated);
  }

  /** Until there is a scene only what is behind it, which costs next to nothing. */
  private drawNow(): void {
    this.dirty = false;
    if (this.scenes === 0) {
      this.renderer.setClearColor(themes[this.theme].background);
      this.renderer.clear();
      return;
    }
    this.overlays.refresh();
    this.batches.update(this.camera.position);
    this.shadow.update(this.renderer, this.inTime);
    this.renderer.render(this.scene, this.eye.current(this.room));
    this.frames += 1;
  }

  /** How far things may lie before the camera [m]. */
  private get room(): number {
    return 10 * this.sphere.radius;
  }

  private parts(): Part[] {
    return (["visual", "collider"] as const).flatMap((kind) =>
      this.kinds[kind].map((node) => ({
        node,
        kind,
        path: (node.userData.path as string | undefined) ?? "",
        body: (this.carrierOf(node)?.userData.path as string | undefined) ?? "",
      })),
    );
  }

  private nodes(): THREE.Object3D[] {
    return [...this.kinds.body, ...this.kinds.visual, ...this.kinds.collider];
  }

  private clear(): void {
    this.marks.clear();
    this.overlays.clear();
    this.batches.clear();
    this.root.traverse(dispose);
    this.root.parent?.remove(this.root);
    for (const child of [...this.scene.children]) {
      if (child instanceof THREE.Group && child !== this.grid) {
        this.scene.remove(child);
      }
    }
    for (const list of Object.values(this.kinds)) {
      list.length = 0;
    }
    this.bodies = [];
  }

  private resize(): void {
    const { width, height } = sizeOf(this.container);
    const now = this.renderer.getSize(new THREE.Vector2());
    if (this.sized && now.x === width && now.y === height) {
      return; // as an observer says at its beginning
    }
    this.sized = true;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.stand();
    this.renderer.setSize(width, height);
    this.draw(); // at once, since the picture is empty now
  }

  private tick(seconds: number): void {
    if (this.motion?.advance(seconds)) {
      this.moved();
      this.dispatchEvent(new Event("time"));
      this.dirty = true;
    }
    if (this.dirty) {
      this.pace.drawn(seconds);
      this.drawAs(this.pace.share);
    } else if (this.pace.restsAt(seconds, this.shadow.stale)) {
      this.draw();
    }
  }

  /** Draws with a share of the pixels along each side. */
  private drawAs(share: number): void {
    const ratio = this.ratio * share;
    if (this.software && this.renderer.getPixelRatio() !== ratio) {
      this.renderer.setPixelRatio(ratio);
    }
    this.drawNow();
  }

  /** Colliders begin unseen and are drawn so that what they stand for shows through. */
  private prepareColliders(): void {
    const colors = [0x2c9f6b, 0xd9822b, 0x7a5fd0, 0xc0486f, 0x2a8fbd, 0x9a9330];
    for (const node of this.kinds.collider) {
      node.visible = false;
      // A plane has no end and would lie over everything.
      const info = this.info.colliders.find((one) => one.path === node.userData.path);
      const opacity = info?.kind === "plane" ? 0.1 : 0.38;
      const color = colors[(node.userData.piece as number | undefined ?? 0) % colors.length]!;
      node.traverse((part) => {
        if (part instanceof THREE.Mesh) {
          part.material = new THREE.MeshStandardMaterial({
            color,
            transparent: true,
            opacity,
            depthWrite: false,
            roughness: 0.8,
            flatShading: true,
            side: THREE.DoubleSide,
            // Before what lies in the same plane, which would flicker.
            polygonOffset: true,
            polygonOffsetFactor: -1,
            polygonOffsetUnits: -1,
          });
        }
      });
    }
  }

  private measure(): void {
    this.scene.updateMatrixWorld(true);
    const box = new THREE.Box3();
    const seen = this.kinds.visual.length > 0 ? this.kinds.visual : this.kinds.collider;
    const part = new THREE.Box3();
    const drawn = seen
      .map((node) => ({ node, box: part.clone().setFromObject(node) }))
      .filter((one) => !one.box.isEmpty());
    const moves = (node: THREE.Object3D) => this.bodyOf(node)?.kinematic === false;
    const counts = fitted(drawn.map((one) => ({ box: one.box, moves: moves(one.node) })));
    const subject = drawn.filter((_, i) => counts[i]);
    this.fitted = subject.map((one) => one.node);
    subject.forEach((one) => box.union(one.box));
    if (box.isEmpty()) {
      for (const body of this.bodies) {
        box.expandByPoint(body.getWorldPosition(new THREE.Vector3()));
      }
    }
    if (box.isEmpty()) {
      box.set(new THREE.Vector3(-0.5, -0.5, -0.5), new THREE.Vector3(0.5, 0.5, 0.5));
    }
    box.getBoundingSphere(this.sphere);
    this.sphere.radius = Math.max(this.sphere.radius, 1e-4);
    this.grid.position.set(this.sphere.center.x, box.min.y, this.sphere.center.z);
  }

  /** Squares around the scene that fade away. Short lines: software clips long ones badly. */
  private makeGrid(): void {
    for (const child of [...this.grid.children]) {
      if (child instanceof THREE.LineSegments) {
        this.grid.remove(child);
        child.geometry.dispose();
        (child.material as THREE.Material).dispose();
      }
    }
    const step = 10 ** Math.round(Math.log10(this.sphere.radius / 3));
    const lines = gridLines(step, themes[this.theme]);
    lines.userData.ofPage = true;
    this.grid.add(lines);
  }

  private listenToPointer(canvas: HTMLCanvasElement): void {
    let from: [number, number] = [0, 0];
    canvas.addEventListener("pointerdown", (event) => {
      from = [event.clientX, event.clientY];
    });
    canvas.addEventListener("pointerup", (event) => {
      const moved = Math.hypot(event.clientX - from[0], event.clientY - from[1]);
      if (event.button === 0 && moved < 4) {
        const hit = this.pick(event.clientX, event.clientY);
        const path = hit ? this.bodyPathOf(hit.object) : "";
        if (event.ctrlKey || event.metaKey) {
          path && this.selectAlso(path);
        } else if (!this.picksPoints) {
          this.select(path);
        }
      }
    });
  }

  /** Clicks name points, and select nothing. */
  picksPoints = false;

  /** The ray that is seen as a point at a place of the window. */
  rayAt(clientX: number, clientY: number): THREE.Raycaster {
    const box = this.renderer.domElement.getBoundingClientRect();
    const at = new THREE.Vector2(
      ((clientX - box.left) / box.width) * 2 - 1,
      1 - ((clientY - box.top) / box.height) * 2,
    );
    const ray = new THREE.Raycaster();
    ray.setFromCamera(at, this.eye.current(this.room));
    ray.layers.enable(batched);
    return ray;
  }

  /** What is drawn at a place of the window. */
  pick(clientX: number, clientY: number): THREE.Intersection | undefined {
    const ray = this.rayAt(clientX, clientY);
    const seen = [...this.kinds.visual, ...this.kinds.collider].filter((node) => node.visible);
    return ray.intersectObjects(seen, true)[0];
  }

  /** The node of the body that carries a node. */
  carrierOf(part: THREE.Object3D): THREE.Object3D | null {
    let node: THREE.Object3D | null = part;
    while (node && node.userData.kind !== "body") {
      node = node.parent;
    }
    return node;
  }

  /** The enabled body that carries a node. */
  private bodyOf(part: THREE.Object3D): BodyInfo | undefined {
    const node = this.carrierOf(part);
    const body = node ? this.info.bodies[node.userData.index as number] : undefined;
    return body?.enabled ? body : undefined;
  }

  /** The body that a part belongs to, else the part's own path. */
  bodyPathOf(part: THREE.Object3D): string {
    let own = "";
    for (let node: THREE.Object3D | null = part; node; node = node.parent) {
      const path = node.userData.path as string | undefined;
      own ||= path ?? "";
      if (node.userData.kind === "body") {
        return path ?? "";
      }
    }
    return own;
  }
}
