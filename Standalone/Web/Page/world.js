// SPDX-License-Identifier: MIT
// Draws the world: bodies at their poses, outlines of vibrating bodies, flashes of impacts, and actuators as badges.
import * as look from './look.js';

const badge = 26, margin = 20; // px
const glowMs = 450;

export class World {
    scene = null;
    poses = [];
    places = []; // of enchanters, in shares of the field
    chosen = -1;
    #hits = [];

    constructor(canvas) { this.canvas = canvas; }

    show(scene) {
        this.scene = scene;
        this.poses = [];
        this.#hits = [];
        this.materials = new Map(scene.materials.map((material, index) => [material.name, index]));
        for (const body of scene.bodies) for (const fixture of body.fixtures) fixture.outline = outlineOf(fixture);
    }
    add(hits) { if (!document.hidden) for (const hit of hits) this.#hits.push({ hit, at: performance.now() }); } // a hidden page draws none, so none would expire

    /// Maps metres of the field to pixels of the canvas, and back.
    get map() {
        const [width, height] = this.scene.field_m, { clientWidth, clientHeight } = this.canvas;
        const scale = Math.min((clientWidth - 2 * margin) / width, (clientHeight - 2 * margin) / height);
        return { scale, left: (clientWidth - width * scale) / 2, bottom: (clientHeight + height * scale) / 2, width: width * scale, height: height * scale };
    }
    metresAt(px, py) { const { scale, left, bottom } = this.map; return [(px - left) / scale, (bottom - py) / scale]; }
    pixelOfPlace([x, y]) { const { left, bottom, width, height } = this.map; return [left + x * width, bottom - y * height]; }
    placeAt(px, py) {
        const { left, bottom, width, height } = this.map, clamp = value => Math.min(1, Math.max(0, value));
        return [clamp((px - left) / width), clamp((bottom - py) / height)];
    }

    enchanterAt(px, py) {
        return this.places.findIndex(place => { const [x, y] = this.pixelOfPlace(place); return Math.hypot(px - x, py - y) < badge * 0.8; });
    }

    /// The topmost body there that the user can move, with a finger width of 12 px; -1: none.
    bodyAt(px, py) {
        const { scale, left, bottom } = this.map, context = this.canvas.getContext('2d'), reach = 24;
        for (let i = this.scene.bodies.length - 1; i >= 0; --i) {
            const body = this.scene.bodies[i], [x, y, angle, isPresent] = this.poses.subarray?.(4 * i, 4 * i + 4) ?? [];
            if (body.type === 'static' || !isPresent) continue;
            context.save();
            context.resetTransform();
            context.translate(left + x * scale, bottom - y * scale);
            context.rotate(-angle);
            context.scale(scale, -scale);
            context.lineWidth = reach / scale;
            const isIn = body.fixtures.some(({ outline, shape }) => (shape !== 'chain' && context.isPointInPath(outline, px, py)) || context.isPointInStroke(outline, px, py));
            context.restore();
            if (isIn) return i;
        }
        return -1;
    }

    draw() {
        const context = look.fresh(this.canvas);
        if (!this.scene) return;
        const { scale, left, bottom, width, height } = this.map;
        context.fillStyle = look.ground;
        context.fillRect(left, bottom - height, width, height);
        this.scene.bodies.forEach((body, i) => this.#drawBody(context, body, this.poses.subarray?.(4 * i, 4 * i + 4) ?? [], scale, left, bottom));
        this.#drawHits(context, scale, left, bottom);
        this.places.forEach((place, j) => this.#drawBadge(context, place, j));
    }

    #drawBody(context, body, [x, y, angle, isPresent], scale, left, bottom) {
        if (!isPresent) return;
        context.save();
        context.translate(left + x * scale, bottom - y * scale);
        context.rotate(-angle);
        context.scale(scale, -scale);
        for (const fixture of body.fixtures) {
            context.globalAlpha = body.type === 'static' ? 0.65 : 1; // static bodies are paler
            context.fillStyle = look.materialColour(this.materials.get(fixture.material) ?? 0);
            context.strokeStyle = fixture.camera ? look.camera : context.fillStyle;
            context.lineWidth = (fixture.camera ? 2 : 1) / scale;
            if (fixture.shape !== 'chain') context.fill(fixture.outline);
            context.globalAlpha = 1;
            if (fixture.camera || fixture.shape === 'chain') context.stroke(fixture.outline);
            if (fixture.shape === 'circle' && body.type !== 'static') this.#drawSpoke(context, fixture, scale);
        }
        context.restore();
    }

    #drawSpoke(context, { radius_m, offset_m: [x, y] = [0, 0] }, scale) {
        context.beginPath();
        context.moveTo(x, y);
        context.lineTo(x + 0.8 * radius_m, y);
        context.strokeStyle = '#0008';
        context.lineWidth = 1.5 / scale;
        context.stroke();
    }

    #drawHits(context, scale, left, bottom) {
        const time = performance.now();
        this.#hits = this.#hits.filter(({ at }) => time - at < glowMs);
        for (const { hit: [x, y, , , amplitude], at } of this.#hits) {
            const age = (time - at) / glowMs, strength = Math.min(1, Math.sqrt(Math.abs(amplitude)) * 1.6);
            context.globalAlpha = (1 - age) * strength;
            context.strokeStyle = context.fillStyle = look.now;
            context.lineWidth = 1.5;
            context.beginPath();
            context.arc(left + x * scale, bottom - y * scale, 4 + strength * (8 + 22 * age), 0, 7);
            context.stroke();
            context.beginPath();
            context.arc(left + x * scale, bottom - y * scale, 2 + 4 * strength * (1 - age), 0, 7);
            context.fill();
        }
        context.globalAlpha = 1;
    }

    #drawBadge(context, place, j) {
        const [x, y] = this.pixelOfPlace(place);
        context.beginPath();
        context.roundRect(x - badge / 2, y - badge / 2, badge, badge, 6);
        context.fillStyle = j === this.chosen ? look.enchanterColours[j] : look.ground;
        context.strokeStyle = look.enchanterColours[j];
        context.lineWidth = 2;
        context.fill();
        context.stroke();
        context.fillStyle = j === this.chosen ? look.ground : look.enchanterColours[j];
        context.font = '600 13px system-ui, sans-serif';
        context.textAlign = 'center';
        context.textBaseline = 'middle';
        context.fillText(look.letter(j), x, y + 0.5);
    }
}

// In metres, relative to the body.
function outlineOf({ shape, radius_m, size_m, vertices_m, loop, offset_m = [0, 0], angle_rad = 0 }) {
    const path = new Path2D(), own = new Path2D();
    if (shape === 'circle') own.arc(0, 0, radius_m, 0, 7);
    else if (shape === 'box') own.rect(-size_m[0] / 2, -size_m[1] / 2, ...size_m);
    else {
        vertices_m.forEach(([x, y]) => own.lineTo(x, y));
        if (shape === 'polygon' || loop) own.closePath();
    }
    path.addPath(own, new DOMMatrix().translate(...offset_m).rotate((angle_rad * 180) / Math.PI));
    return path;
}
