// SPDX-License-Identifier: MIT
import * as Phaser from 'phaser';
import { load } from 'physvib';
import { attach } from 'physvib/matter';
import { rumble } from 'physvib/gamepad';

const physvib = await load();
class Box extends Phaser.Scene {
    create() {
        this.matter.world.setBounds(0, 0, 800, 600);
        const ball = this.matter.add.circle(400, 100, 20, { restitution: 0.7 });
        this.haptics = attach(physvib, this.matter.world.engine, { metresPerUnit: 0.01, fieldWidth: 8, fieldHeight: 6 });
        this.haptics.set(ball, { isSource: true, frequencyHz: 80, decayPerSecond: 20 });
        rumble(physvib, { fieldWidth: 8, fieldHeight: 6 }).follow(this.haptics);
    }
}
new Phaser.Game({ width: 800, height: 600, physics: { default: 'matter' }, scene: Box });
