// SPDX-License-Identifier: MIT
// A ball that bounces in MuJoCo: in Node, or a page.
import loadMujoco from '@mujoco/mujoco';
import { feel } from 'physvib/feel';

const mujoco = await loadMujoco();
const model = mujoco.MjModel.from_xml_string(`<mujoco><worldbody><geom type="plane" size="5 5 1" solref="0.02 0.22"/>
    <body name="ball" pos="0 0 0.9"><freejoint/><geom type="sphere" size="0.1" mass="0.2" solref="0.02 0.22"/></body></worldbody></mujoco>`), data = new mujoco.MjData(model);

const felt = await feel({ mujoco, model, data }, { fieldWidth: 4, fieldHeight: 3, fieldX: -2 }); // the field is the plane of x and z
felt.set('ball', { isSource: true, material: 'wooden board' });
felt.haptics.follow(events => { for (const { timeNs, impulse } of events) console.log(`${(timeNs * 1e-6).toFixed(0)} ms: ${impulse.toFixed(2)} N s`); });
while (data.time < 2) felt.update(); // instead of mujoco.mj_step(model, data)
felt.close();
