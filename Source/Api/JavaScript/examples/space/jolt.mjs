// SPDX-License-Identifier: MIT
// A ball that bounces in Jolt: in Node, or a page.
import initJolt from 'jolt-physics';
import { feel } from 'physvib/feel';

const Jolt = await initJolt(), settings = new Jolt.JoltSettings(), pairs = new Jolt.ObjectLayerPairFilterTable(2), layers = new Jolt.BroadPhaseLayerInterfaceTable(2, 2), [still, moving] = [0, 1];
pairs.EnableCollision(still, moving);
pairs.EnableCollision(moving, moving);
for (const layer of [still, moving]) layers.MapObjectToBroadPhaseLayer(layer, new Jolt.BroadPhaseLayer(layer));
settings.mObjectLayerPairFilter = pairs;
settings.mBroadPhaseLayerInterface = layers;
settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 2);
const jolt = new Jolt.JoltInterface(settings), bodies = jolt.GetPhysicsSystem().GetBodyInterface();
function add(shape, y, type, layer) {
    const made = new Jolt.BodyCreationSettings(shape, new Jolt.RVec3(0, y, 0), new Jolt.Quat(0, 0, 0, 1), type, layer);
    made.mRestitution = 0.5;
    made.mOverrideMassProperties = Jolt.EOverrideMassProperties_CalculateInertia;
    made.mMassPropertiesOverride.mMass = 0.2;
    const body = bodies.CreateBody(made);
    bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
    return body;
}
add(new Jolt.BoxShape(new Jolt.Vec3(5, 0.5, 5)), -0.5, Jolt.EMotionType_Static, still);
const ball = add(new Jolt.SphereShape(0.1), 0.9, Jolt.EMotionType_Dynamic, moving);

const felt = await feel({ Jolt, interface: jolt }, { fieldWidth: 4, fieldHeight: 3, fieldX: -2 });
felt.set(ball, 'wooden board');
felt.haptics.follow(events => { for (const { timeNs, impulse } of events) console.log(`${(timeNs * 1e-6).toFixed(0)} ms: ${impulse.toFixed(2)} N s`); });
for (let i = 0; i < 120; ++i) jolt.Step(1 / 60, 1); // in each frame
felt.close();
