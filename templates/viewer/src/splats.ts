// SPDX-License-Identifier: Apache-2.0
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {GLTFGaussianSplatLoaderExtension} from 'three/addons/loaders/GLTFGaussianSplatLoaderExtension.js';
import type {GaussianSplat} from 'three/addons/objects/GaussianSplat.js';
import {Fn, cameraProjectionMatrix, cameraWorldMatrix, dot, float, positionGeometry, smoothstep, varyingProperty, vec4} from 'three/tsl';
import {Camera, Group, Vector3} from 'three/webgpu';
import type {Node, Sky} from './sky';

/** What the splat object of three.js 0.187 keeps to itself and this page touches; the version is pinned. */
interface SplatInternals {
  _sphericalHarmonicsVertexNode: Node;
  _precomputedSphericalHarmonicsVertexNode: Node;
  _lastSortDirection: Vector3;
}

export class Splats {
  readonly root = new Group();
  readonly meshes: GaussianSplat[] = [];
  private readonly center = new Vector3();

  static async load(bytes: ArrayBuffer, sky: Sky, behindMountains: boolean): Promise<Splats> {
    const loader = new GLTFLoader();
    loader.register((parser) => new GLTFGaussianSplatLoaderExtension(parser) as never);
    const model = await loader.parseAsync(bytes, '');
    const splats = new Splats();
    splats.root.add(model.scene);
    model.scene.updateMatrixWorld(true);
    model.scene.traverse((object) => {
      if ('isGaussianSplat' in object) splats.meshes.push(object as GaussianSplat);
    });
    for (const mesh of splats.meshes) seeThroughAir(mesh, sky, behindMountains);
    return splats;
  }

  get count(): number {
    return this.meshes.reduce((sum, mesh) => sum + mesh.splatGeometry.getAttribute('position').count, 0);
  }

  /** Draws far tiles before near ones: three.js orders splats within an object only. */
  orderFrom(camera: Camera): void {
    const distance = new Map<GaussianSplat, number>();
    for (const mesh of this.meshes) {
      if (!mesh.boundingSphere) mesh.computeBoundingSphere();
      this.center.copy(mesh.boundingSphere!.center).applyMatrix4(mesh.matrixWorld);
      distance.set(mesh, this.center.distanceTo(camera.position));
    }
    [...this.meshes]
      .sort((a, b) => distance.get(b)! - distance.get(a)!)
      .forEach((mesh, index) => (mesh.renderOrder = 10 + index));
  }

  /** Sorts again at the next frame: three.js does so by itself when the view turns, not when it moves. */
  sortAgain(): void {
    for (const mesh of this.meshes) (mesh as unknown as SplatInternals)._lastSortDirection.set(0, 0, 0);
  }

  exaggerate(factor: number): void {
    this.root.scale.y = factor;
    this.root.updateMatrixWorld(true);
  }

  /**
   * Calls back with the centre in scene metres, the deviation and the opacity of every splat.
   * The deviation is that of the circle with the area of the splat seen from above.
   */
  forEach(visit: (center: Vector3, deviationMeters: number, opacity: number) => void): void {
    const center = new Vector3();
    for (const mesh of this.meshes) {
      const position = mesh.splatGeometry.getAttribute('position');
      const covariance = mesh.splatGeometry.getAttribute('covariance');
      const colors = mesh.splatGeometry.getAttribute('color').array;
      const scale = mesh.matrixWorld.getMaxScaleOnAxis();
      for (let i = 0; i < position.count; ++i) {
        center.fromBufferAttribute(position, i).applyMatrix4(mesh.matrixWorld);
        const [xx, xz, zz] = [0, 2, 5].map((k) => covariance.getComponent(i, k));
        visit(center, scale * Math.pow(Math.max(0, xx * zz - xz * xz), 0.25), colors[4 * i + 3] / 255);
      }
    }
  }
}

/**
 * Mixes the colour of the air into a splat's own, and fades its rim; its material has no place for either.
 * Splats hide behind what has written depth: mountains, where there are any.
 */
function seeThroughAir(mesh: GaussianSplat, sky: Sky, behindMountains: boolean): void {
  const internals = mesh as unknown as SplatInternals;
  const place: Node = varyingProperty('vec3', 'splatPlace');
  const corner: Node = varyingProperty('vec2', 'splatCorner');
  const projection: Node = cameraProjectionMatrix;
  const placed = (vertex: Node): Node =>
    vertex &&
    Fn(() => {
      const clip = vec4(vertex).toVar();
      const view = vec4(
        clip.x.div(projection.element(0).element(0)),
        clip.y.div(projection.element(1).element(1)),
        clip.w.negate(),
        1,
      );
      corner.assign(positionGeometry.xy);
      place.assign(cameraWorldMatrix.mul(view).xyz);
      return clip;
    })();
  internals._sphericalHarmonicsVertexNode = placed(internals._sphericalHarmonicsVertexNode);
  internals._precomputedSphericalHarmonicsVertexNode = placed(internals._precomputedSphericalHarmonicsVertexNode);
  const drawn: Node = mesh.material.colorNode;
  mesh.material.vertexNode = internals._precomputedSphericalHarmonicsVertexNode;
  mesh.material.colorNode = Fn(() => {
    const color = vec4(drawn).toVar();
    // three.js cuts a splat off at two deviations, where an eighth of it is left: an edge that the eye finds.
    const rim = smoothstep(float(4), float(1.6), dot(corner, corner));
    return vec4(sky.throughAir(color.rgb, place), color.a.mul(rim));
  })();
  mesh.material.depthTest = behindMountains;
}
