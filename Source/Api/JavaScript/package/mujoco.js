// SPDX-License-Identifier: MIT
// Attaches to MuJoCo 3 (@mujoco/mujoco), whose contacts are springs, so an impact is reported by its speed and its solref. As in physvib_mujoco.h, the field is the plane of
// x and z, and its z is MuJoCo's -y.
import { expectEngine } from './haptics.js';
import { inverseOf, SpaceHaptics } from './reader.js';

const body = 1, sphere = 2; // mjOBJ_BODY, mjGEOM_SPHERE
const turned = (list, at) => ({ x: list[at], y: list[at + 2], z: -list[at + 1] });

/** How much of its speed a spring and a damper give back: solref's [seconds, damping ratio], or [-stiffness, -damping]. */
function bounceOf([first, second]) {
    const ratio = first > 0 ? second : -second / (2 * Math.sqrt(-first));
    return ratio < 1 ? Math.exp(-Math.PI * ratio / Math.sqrt(1 - ratio * ratio)) : 0;
}
/** The force along the normal: of an elliptic cone, the first number; of a pyramid, the sum of its edges. */
function forceOf({ efc_address: at, dim }, forces, isPyramid) {
    let sum = 0;
    for (let i = at, end = at + (isPyramid && dim > 1 ? 2 * (dim - 1) : 1); at >= 0 && i < end; ++i) sum += forces[i];
    return sum;
}

class MujocoHaptics extends SpaceHaptics {
    #parts; #speeds;

    constructor(physvib, { mujoco, model, data }, { restitution, ...options }) {
        const speeds = new mujoco.DoubleBuffer(6), still = [], isRound = [], isPyramid = Number(model.opt.cone) === 0;
        for (let i = 0; i < model.nbody; ++i) {
            still.push(model.body_weldid[i] === 0 || model.body_mocapid[i] >= 0);
            isRound.push(model.body_geomnum[i] === 1 && model.geom_type[model.body_geomadr[i]] === sphere);
        }
        super(physvib, {
            tellsImpulses: true, options: ['restitution'], isThere: () => true, bodies: () => still.keys(), gravity: () => turned(model.opt.gravity, 0),
            bodyOf(thing) { const id = typeof thing === 'string' ? mujoco.mj_name2id(model, body, thing) : thing; return Number.isInteger(id) && id >= 0 && id < still.length ? id : undefined; },
            massesOf: id => (still[id] ? { massKg: 0, inertia: 0, gravityScale: 1 } : { massKg: model.body_mass[id], inertia: 0, gravityScale: 1 - (model.body_gravcomp?.[id] ?? 0) }),
            read(id, to) {
                mujoco.mj_objectVelocity(model, data, body, id, speeds, 0);
                const v = speeds.GetView(), axes = data.ximat, at = 9 * id, inertia = model.body_inertia;
                to.at = turned(data.xipos, 3 * id);
                to.v = turned(v, 3);
                to.turns = turned(v, 0);
                to.inverse = model.body_invweight0[2 * id + 1] < 1e-12 ? [0, 0, 0, 0, 0, 0] : inverseOf([0, 1, 2].map(i => inertia[3 * id + i]), [0, 1, 2].map(i => turned([axes[at + i], axes[at + 3 + i], axes[at + 6 + i]], 0)));
                to.isRound = isRound[id];
            },
            contacts(tell) {
                const all = data.contact, count = data.ncon, forces = data.efc_force, { timestep } = model.opt;
                for (let i = 0; i < count; ++i) {
                    const one = all.get(i), gap = one.dist - one.includemargin; // with a margin geoms push before they overlap
                    if (gap <= 0 && one.geom1 >= 0 && one.geom2 >= 0) tell(model.geom_bodyid[one.geom1], model.geom_bodyid[one.geom2], turned(one.pos, 0), turned(one.frame, 0), gap, restitution ?? bounceOf(one.solref), 0, timestep * forceOf(one, forces, isPyramid));
                    one.delete();
                }
                all.delete();
            },
        }, options);
        this.#parts = { mujoco, model, data };
        this.#speeds = speeds;
    }

    /** Instead of mj_step; `seconds` is the model's. */
    step() {
        const { mujoco, model, data } = this.#parts;
        mujoco.mj_step1(model, data); // contacts where bodies are, and the velocities that led there
        this.before(model.opt.timestep);
        mujoco.mj_step2(model, data);
        this.after();
    }
    detach() { this.#speeds.delete(); }
}

/** `engine`: { mujoco, model, data }; bodies are their ids, or names. `restitution`: instead of what solref says. All integrators but RK4. */
export function attach(physvib, engine, options = {}) {
    expectEngine(engine?.mujoco?.mj_step1 && engine.model && engine.data, '{ mujoco, model, data }', engine);
    return new MujocoHaptics(physvib, engine, options);
}
