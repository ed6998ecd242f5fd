// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What pictures are drawn with: the canvas and its context, and giving back what it holds.
import * as THREE from "three";

export interface Size {
  width: number;
  height: number;
}

/** Of a box in the page, one pixel at least. */
export function sizeOf(box: HTMLElement): Size {
  return { width: Math.max(1, box.clientWidth), height: Math.max(1, box.clientHeight) };
}

export interface Graphics {
  canvas: HTMLCanvasElement;
  context: WebGL2RenderingContext | null;
  /** Pictures are computed by the processor. */
  software: boolean;
}

/**
 * What is drawn with. Unless it is said, edges are smoothed where that is not software's work. The
 * canvas has its size before it has a context: each change of it later allocates all buffers again.
 */
export function openGraphics(antialias: boolean | undefined, { width, height }: Size): Graphics {
  const open = (smooth: boolean) => {
    const canvas = document.createElement("canvas");
    Object.assign(canvas, { width, height });
    const context = canvas.getContext("webgl2", {
      antialias: smooth,
      preserveDrawingBuffer: true,
    });
    return { canvas, context };
  };
  const first = open(antialias ?? false);
  const names = first.context?.getExtension("WEBGL_debug_renderer_info");
  const name = names ? String(first.context!.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  const software = /swiftshader|llvmpipe|software|basic render/i.test(name);
  if (software || antialias !== undefined) {
    return { ...first, software };
  }
  first.context?.getExtension("WEBGL_lose_context")?.loseContext();
  return { ...open(true), software };
}

/** Gives back what the graphics hold for a part. */
export function dispose(part: THREE.Object3D): void {
  if (!(part instanceof THREE.Mesh)) {
    return;
  }
  part.geometry.dispose();
  for (const material of [part.material as THREE.Material | THREE.Material[]].flat()) {
    for (const value of Object.values(material)) {
      if (value instanceof THREE.Texture) {
        value.dispose();
      }
    }
    material.dispose();
  }
}
