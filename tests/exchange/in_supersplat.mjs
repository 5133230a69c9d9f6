// Reads viewer settings as SuperSplat's viewer does, and prints where its camera is at given times.
//
//     node tests/exchange/in_supersplat.mjs NODE_FOLDER SETTINGS.JSON [limits] < TIMES.JSON
//
// NODE_FOLDER is where npm installed @playcanvas/supersplat-viewer and playcanvas. The settings are checked by the
// viewer's own code, with `limits` also for what it asks of editors: whole frame numbers, at most 1000 keys. Its classes
// of animation and camera are not exported: a copy of the installed module, beside it, exports them. Prints a JSON list
// of rows: position and quaternion (x, y, z, w) with OpenGL camera axes in the viewer's world, and the field of view
// along the larger side of the image in degrees.

import { readFileSync, writeFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [folder, file, limits] = process.argv.slice(2);
const modules = resolve(folder, 'node_modules');
const load = (path) => import(pathToFileURL(resolve(modules, path)));

const viewer = '@playcanvas/supersplat-viewer/dist/';
const source = readFileSync(resolve(modules, viewer, 'viewer.js'), 'utf8');
writeFileSync(resolve(modules, viewer, 'opened.mjs'), `${source}\nexport { AnimState, Camera, Quat };\n`);
const { AnimState, Camera, Quat } = await load(`${viewer}opened.mjs`);
const { importSettings, validateSettings } = await load(`${viewer}settings.js`);

const settings = JSON.parse(readFileSync(file, 'utf8'));
validateSettings(settings, { limits: limits === 'limits' });
const animation = AnimState.fromTrack(importSettings(settings).animTracks[0]);
const camera = new Camera();
const rows = JSON.parse(readFileSync(0, 'utf8')).map((secs) => {
    animation.cursor.value = secs;
    animation.update(0);
    camera.look(animation.position, animation.target);
    const { x, y, z } = camera.position;
    const turn = new Quat().setFromEulerAngles(camera.angles);
    return [[x, y, z], [turn.x, turn.y, turn.z, turn.w], animation.fov];
});
console.log(JSON.stringify(rows));
