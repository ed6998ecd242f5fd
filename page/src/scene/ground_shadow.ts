// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The soft shadow on the ground below what is drawn, as under a cloudy sky: how close things are
// is drawn from below, small, and blurred. It is drawn again only when something has moved.
import * as THREE from "three";

const pixels = 128; // along each side
const strength = 0.55; // of the shadow right below what touches the ground
const reach = 0.5; // how far above the ground things cast it, in radii of the scene
const blurred = 0.06; // of the shadow's side
/** What is as flat as this, in radii of the scene, is ground itself. */
const flat = 0.01;

const whole = "varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }";

/** Darker the closer to the ground. */
const closeness = new THREE.ShaderMaterial({
  vertexShader: "void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
  fragmentShader: "void main() { float close = 1.0 - gl_FragCoord.z; gl_FragColor = vec4(0.0, 0.0, 0.0, close * close); }",
  side: THREE.DoubleSide,
});

/** Half of a blur: along one direction. */
const blur = new THREE.ShaderMaterial({
  uniforms: { image: { value: null }, shift: { value: new THREE.Vector2() } },
  vertexShader: whole,
  fragmentShader: `
    uniform sampler2D image; uniform vec2 shift; varying vec2 at;
    void main() {
      float sum = 0.0;
      float weights = 0.0;
      for (int i = -4; i <= 4; ++i) {
        float weight = exp(-0.12 * float(i * i));
        sum += weight * texture2D(image, at + float(i) * shift).a;
        weights += weight;
      }
      gl_FragColor = vec4(0.0, 0.0, 0.0, sum / weights);
    }`,
  depthTest: false,
  depthWrite: false,
});

interface Caster {
  part: THREE.Mesh;
  copy: THREE.Mesh;
}

const isSeen = (part: THREE.Object3D | null): boolean => part === null || (part.visible && isSeen(part.parent));

function isOpaque(part: THREE.Mesh): boolean {
  return [part.material as THREE.Material | THREE.Material[]].flat().every((one) => !one.transparent);
}

export class GroundShadow {
  /** To be put on the ground; its parent is not turned. */
  readonly mesh: THREE.Mesh;
  private readonly sharp = new THREE.WebGLRenderTarget(pixels, pixels);
  private readonly soft = new THREE.WebGLRenderTarget(pixels, pixels, { depthBuffer: false });
  private readonly below = new THREE.OrthographicCamera();
  private readonly things = new THREE.Scene();
  private readonly sheet = new THREE.Scene();
  private readonly place = new THREE.Matrix4();
  private casters: Caster[] = [];
  private radius = 1;
  /** Something has moved since it was drawn. */
  stale = false;

  constructor() {
    const ground = new THREE.PlaneGeometry(2, 2).rotateX(-Math.PI / 2);
    this.mesh = new THREE.Mesh(
      ground,
      new THREE.ShaderMaterial({
        uniforms: { image: { value: this.sharp.texture }, place: { value: this.place } },
        vertexShader: `
          uniform mat4 place; varying vec2 at;
          void main() {
            vec4 world = modelMatrix * vec4(position, 1.0);
            at = 0.5 + 0.5 * (place * world).xy;
            gl_Position = projectionMatrix * viewMatrix * world;
          }`,
        fragmentShader: `
          uniform sampler2D image; varying vec2 at;
          void main() { gl_FragColor = vec4(0.0, 0.0, 0.0, ${strength} * texture2D(image, at).a); }`,
        transparent: true,
        depthWrite: false,
        polygonOffset: true, // over a ground in the same plane
        polygonOffsetFactor: -1,
        polygonOffsetUnits: -1,
      }),
    );
    this.mesh.userData.ofPage = true;
    this.mesh.renderOrder = -1;
    this.mesh.visible = false;
    const page = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), blur);
    page.frustumCulled = false;
    this.sheet.add(page);
  }

  /** What casts it: all opaque meshes of these nodes. */
  begin(nodes: readonly THREE.Object3D[], radius: number): void {
    this.radius = radius;
    this.casters = [];
    this.things.clear();
    for (const node of nodes) {
      node.traverse((part) => {
        if (part instanceof THREE.Mesh && !part.userData.ofPage && isOpaque(part)) {
          const copy = new THREE.Mesh(part.geometry as THREE.BufferGeometry, closeness);
          copy.matrixAutoUpdate = false;
          copy.matrixWorldAutoUpdate = false;
          copy.matrixWorld = part.matrixWorld;
          copy.frustumCulled = false;
          this.things.add(copy);
          this.casters.push({ part, copy });
        }
      });
    }
    this.stale = true;
  }

  /** Before a picture is drawn. Where there is no time for it, a shadow that is no longer true is not seen. */
  update(renderer: THREE.WebGLRenderer, inTime: boolean): void {
    if (this.stale && inTime) {
      this.stale = false;
      const box = this.standing();
      this.mesh.userData.empty = box.isEmpty();
      box.isEmpty() || this.draw(renderer, box);
    }
    this.mesh.visible = !this.stale && this.mesh.userData.empty === false;
  }

  /** The box of what stands on the ground, or just above it; only that is drawn. */
  private standing(): THREE.Box3 {
    const ground = this.mesh.parent?.position.y ?? 0;
    const all = new THREE.Box3();
    const box = new THREE.Box3();
    for (const { part, copy } of this.casters) {
      part.updateWorldMatrix(true, false);
      part.geometry.boundingBox ?? part.geometry.computeBoundingBox();
      box.copy(part.geometry.boundingBox as THREE.Box3).applyMatrix4(part.matrixWorld);
      copy.visible =
        isSeen(part) &&
        box.min.y < ground + reach * this.radius &&
        box.max.y > ground + flat * this.radius;
      copy.visible && all.union(box);
    }
    return all;
  }

  private draw(renderer: THREE.WebGLRenderer, box: THREE.Box3): void {
    const { below, mesh, place } = this;
    const middle = box.getCenter(new THREE.Vector3());
    const size = box.getSize(new THREE.Vector3());
    const half = 0.6 * Math.max(size.x, size.z) + 0.1 * this.radius;
    const ground = mesh.parent?.position ?? new THREE.Vector3();
    mesh.position.set(middle.x - ground.x, 0, middle.z - ground.z);
    mesh.scale.setScalar(half);
    Object.assign(below, { left: -half, right: half, top: half, bottom: -half });
    below.near = -flat * this.radius;
    below.far = reach * this.radius;
    below.position.set(middle.x, ground.y, middle.z);
    below.up.set(0, 0, 1);
    below.lookAt(middle.x, ground.y + 1, middle.z);
    below.updateMatrixWorld();
    below.updateProjectionMatrix();
    place.multiplyMatrices(below.projectionMatrix, below.matrixWorldInverse);
    const color = renderer.getClearColor(new THREE.Color());
    const alpha = renderer.getClearAlpha();
    renderer.setClearColor(0x000000, 0);
    this.pass(renderer, this.things, this.sharp);
    this.blurInto(renderer, this.sharp, this.soft, [blurred / 4, 0]);
    this.blurInto(renderer, this.soft, this.sharp, [0, blurred / 4]);
    renderer.setRenderTarget(null);
    renderer.setClearColor(color, alpha);
  }

  private blurInto(
    renderer: THREE.WebGLRenderer,
    from: THREE.WebGLRenderTarget,
    to: THREE.WebGLRenderTarget,
    [x, y]: [number, number],
  ): void {
    blur.uniforms.image!.value = from.texture;
    (blur.uniforms.shift!.value as THREE.Vector2).set(x, y);
    this.pass(renderer, this.sheet, to);
  }

  private pass(renderer: THREE.WebGLRenderer, scene: THREE.Scene, target: THREE.WebGLRenderTarget): void {
    renderer.setRenderTarget(target);
    renderer.render(scene, this.below);
  }
}
