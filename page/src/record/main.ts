// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// `tenon record` runs this script in an empty page, or in that of a report, and calls what is in
// `window.tenonRecord`: first `add` for the pieces of the scene, then `prepare`, then `still`, or
// `begin`, `frame` for each frame and `end`; `take` hands out what was made. Nothing depends on a
// clock: a frame is drawn when it is asked for, at the time that is asked for.
import {
  BufferTarget,
  CanvasSource,
  Mp4OutputFormat,
  Output,
  WebMOutputFormat,
  canEncodeVideo,
} from "mediabunny";
import * as THREE from "three";
import type { Panel } from "../panel/panel";
import { Layers } from "../panel/layers";
import { Viewer } from "../scene/viewer";
import type { Film, Orbit, Outcome, Settings } from "./settings";

/** Drawn twice as large and made smaller, so that edges are smooth. */
const oversampling = 2;
const keyFrameSeconds = 2;
/** What is looked at leaves this share of the picture free. */
const margin = 0.06;
/** Degrees between the angles that a turn is fitted at. */
const turnStep = 10;

function bytesOf(base64: string): Uint8Array {
  return Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
}

function base64Of(bytes: Uint8Array): string {
  const parts: string[] = [];
  for (let at = 0; at < bytes.length; at += 0x8000) {
    parts.push(String.fromCharCode(...bytes.subarray(at, at + 0x8000)));
  }
  return btoa(parts.join(""));
}

/** Whether a colour is dark, so that lines on it have to be bright. */
function isDark(color: THREE.Color): boolean {
  const { r, g, b } = color;
  return 0.2126 * r + 0.7152 * g + 0.0722 * b < 0.2;
}

class Recording {
  private pieces: Uint8Array[] = [];
  private made = new Uint8Array();
  private viewer!: Viewer;
  private layers!: Pick<Layers, "set" | "has">;
  private settings!: Settings;
  private readonly canvas = document.createElement("canvas");
  /** The middle of what is looked at, and how far the camera is from it [m]; 0: not known yet. */
  private readonly middle = new THREE.Vector3();
  private distance = 0;
  private film: { output: Output; source: CanvasSource; target: BufferTarget; step: number } | null = null;

  /** The next piece of the GLB. */
  add(base64: string): void {
    this.pieces.push(bytesOf(base64));
  }

  async prepare(settings: Settings): Promise<Outcome> {
    if (!document.createElement("canvas").getContext("webgl2")) {
      return { problem: "webgl" };
    }
    this.settings = settings;
    const panel = (window as { tenonPage?: { panel: Panel } }).tenonPage?.panel;
    if (panel) {
      this.viewer = panel.viewer;
      this.layers = panel.layers;
      this.viewer.setPixelRatio(oversampling);
      if (settings.background !== "transparent" && !settings.background.startsWith("#")) {
        panel.setTheme(settings.background as "light" | "dark");
      }
    } else {
      await this.makeViewer();
    }
    this.setBackground();
    const unknown = [...settings.show, ...settings.hide].find((name) => !this.layers.has(name));
    if (unknown !== undefined) {
      return { problem: `layer ${unknown}` };
    }
    settings.show.forEach((name) => this.layers.set(name, true));
    settings.hide.forEach((name) => this.layers.set(name, false));
    for (const path of [settings.select, settings.orbit?.target ?? ""]) {
      if (path !== "" && !this.viewer.nodeAt(path)) {
        return { problem: `prim ${path}` };
      }
    }
    this.viewer.select(settings.select);
    return { duration: this.viewer.motion?.duration ?? 0 };
  }

  /** Draws what is seen at a time [s], the camera turned about the up axis [degrees]. */
  draw(time: number, turn: number): void {
    const { motion } = this.viewer;
    if (motion) {
      motion.playing = false;
      motion.seek(time);
      motion.apply();
      this.viewer.moved();
      this.viewer.dispatchEvent(new Event("time"));
    }
    this.viewer.scene.updateMatrixWorld(true);
    if (this.settings.camera) {
      this.viewer.lookThrough({ path: "", ...this.settings.camera });
    } else if (this.settings.orbit) {
      this.orbit(this.settings.orbit, turn);
    }
    this.viewer.draw();
  }

  /** A PNG. */
  async still(time: number, turn: number): Promise<Outcome> {
    const pen = this.pen();
    this.draw(time, turn);
    this.shrink(pen);
    const blob = await new Promise<Blob | null>((done) => this.canvas.toBlob(done, "image/png"));
    if (!blob) {
      return { problem: "picture" };
    }
    this.made = new Uint8Array(await blob.arrayBuffer());
    return { size: this.made.length };
  }

  async begin(film: Film): Promise<Outcome> {
    const format = film.container === "mp4" ? new Mp4OutputFormat() : new WebMOutputFormat();
    const { width, height } = this.settings;
    const possible: string[] = [];
    for (const codec of format.getSupportedVideoCodecs()) {
      if (await canEncodeVideo(codec, { width, height, bitrate: film.bitrate })) {
        possible.push(codec);
      }
    }
    if (!possible.includes(film.codec)) {
      return { problem: "codec", codecs: possible };
    }
    this.pen();
    const target = new BufferTarget();
    const output = new Output({ format, target });
    const source = new CanvasSource(this.canvas, {
      codec: film.codec,
      bitrate: film.bitrate,
      keyFrameInterval: keyFrameSeconds,
      latencyMode: "quality",
      hardwareAcceleration: "prefer-software",
    });
    output.addVideoTrack(source, { frameRate: film.framesPerSecond });
    await output.start();
    this.film = { output, source, target, step: 1 / film.framesPerSecond };
    return {};
  }

  /** The frame with a number, which shows a time of the motion. */
  async frame(index: number, time: number, turn: number): Promise<Outcome> {
    const film = this.film!;
    this.draw(time, turn);
    this.shrink(this.pen());
    await film.source.add(index * film.step, film.step);
    return {};
  }

  async end(): Promise<Outcome> {
    const film = this.film!;
    await film.output.finalize();
    this.made = new Uint8Array(film.target.buffer ?? new ArrayBuffer(0));
    return { size: this.made.length };
  }

  /** A piece of what was made, as base64. */
  take(offset: number, count: number): string {
    return base64Of(this.made.subarray(offset, offset + count));
  }

  /** Waits until the window shows what was drawn. */
  async shown(): Promise<Outcome> {
    for (let i = 0; i < 2; ++i) {
      await new Promise((done) => requestAnimationFrame(done));
    }
    return {};
  }

  private async makeViewer(): Promise<void> {
    const { width, height } = this.settings;
    const place = document.createElement("div");
    place.style.width = `${width}px`;
    place.style.height = `${height}px`;
    document.body.style.margin = "0";
    document.body.append(place);
    this.viewer = new Viewer(place, { antialias: true, alpha: true, animated: false });
    this.viewer.setPixelRatio(oversampling);
    this.layers = new Layers(this.viewer);
    const scene = new Blob(this.pieces as BlobPart[]);
    this.pieces = [];
    await this.viewer.load(await scene.arrayBuffer());
  }

  private setBackground(): void {
    const { background } = this.settings;
    if (background === "transparent") {
      this.viewer.scene.background = null;
      this.viewer.renderer.setClearAlpha(0);
    } else if (background.startsWith("#")) {
      const color = new THREE.Color(background);
      this.viewer.setTheme(isDark(color) ? "dark" : "light");
      this.viewer.scene.background = color;
    } else {
      this.viewer.setTheme(background as "light" | "dark");
    }
  }

  /** Looks from an angle. How far away is decided once, so that a film has one size. */
  private orbit(orbit: Orbit, turn: number): void {
    const { camera, controls } = this.viewer;
    if (this.distance === 0) {
      const corners = this.cornersOf(orbit.target);
      new THREE.Box3().setFromPoints(corners).getCenter(this.middle);
      for (let at = 0; at <= Math.abs(orbit.turn); at += turnStep) {
        this.aim(orbit, Math.sign(orbit.turn) * at);
        this.distance = Math.max(this.distance, this.fittingDistance(corners));
      }
    }
    this.aim(orbit, turn);
    const away = camera.position.clone().sub(controls.target).normalize();
    camera.position.copy(controls.target).addScaledVector(away, this.distance / orbit.zoom);
    camera.updateMatrixWorld();
  }

  private aim(orbit: Orbit, turn: number): void {
    const azimuth = THREE.MathUtils.degToRad(orbit.azimuth + turn);
    const elevation = THREE.MathUtils.degToRad(orbit.elevation);
    // In glTF's axes up is Y, and a quarter turn about it takes +X to -Z.
    const from = new THREE.Vector3(
      Math.cos(azimuth) * Math.cos(elevation),
      Math.sin(elevation),
      -Math.sin(azimuth) * Math.cos(elevation),
    );
    const { camera, controls } = this.viewer;
    this.viewer.frame(orbit.target, from, orbit.zoom);
    camera.position.add(this.middle).sub(controls.target);
    controls.target.copy(this.middle);
    camera.updateMatrixWorld();
  }

  /** Corners of the boxes around what is looked at. */
  private cornersOf(target: string): THREE.Vector3[] {
    const node = target === "" ? undefined : this.viewer.nodeAt(target);
    const corners: THREE.Vector3[] = [];
    for (const one of node ? [node] : this.viewer.fitted) {
      const { min, max } = new THREE.Box3().setFromObject(one, node === undefined);
      for (let i = 0; i < 8 && min.x <= max.x; ++i) {
        const at = (bit: number, axis: "x" | "y" | "z") => ((i >> bit) & 1 ? max[axis] : min[axis]);
        corners.push(new THREE.Vector3(at(0, "x"), at(1, "y"), at(2, "z")));
      }
    }
    return corners.length > 0 ? corners : [this.viewer.sphere.center.clone()];
  }

  /** How far the camera has to be from what it looks at so that it sees all of the corners. */
  private fittingDistance(corners: THREE.Vector3[]): number {
    const { camera, controls } = this.viewer;
    const room = Math.tan(THREE.MathUtils.degToRad(camera.fov / 2)) * (1 - margin);
    const reach = camera.position.distanceTo(controls.target);
    let distance = this.viewer.sphere.radius / 100;
    for (const corner of corners) {
      const seen = corner.clone().applyMatrix4(camera.matrixWorldInverse);
      const sideways = Math.max(Math.abs(seen.x) / camera.aspect, Math.abs(seen.y));
      distance = Math.max(distance, seen.z + reach + sideways / room);
    }
    return distance;
  }

  /** What pictures are drawn with in their own size. */
  private pen(): CanvasRenderingContext2D {
    const { width, height, background } = this.settings;
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    const pen = this.canvas.getContext("2d", {
      alpha: background === "transparent",
      willReadFrequently: true,
    })!;
    pen.imageSmoothingQuality = "high";
    return pen;
  }

  private shrink(pen: CanvasRenderingContext2D): void {
    const { width, height } = this.settings;
    pen.clearRect(0, 0, width, height);
    pen.drawImage(this.viewer.renderer.domElement, 0, 0, width, height);
  }
}

declare global {
  interface Window {
    tenonRecord: Recording;
  }
}

window.tenonRecord = new Recording();
