#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# vest.py finds, by OSCQuery, a program that another project's library makes (npm's oscquery), and sends to where that says it takes OSC. Needs npm.
# Usage: oscquery.sh
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
. "$root/.ci/packages.sh"
ensure_packages python3-zeroconf
work=$(mktemp -d)
trap 'kill $server $vest 2>/dev/null || :; rm -rf "$work"' EXIT
cd "$work"
echo '{ "private": true }' >package.json
npm install --silent --no-audit --no-fund oscquery@1
cat >server.mjs <<'CODE'
import { OSCQueryServer } from 'oscquery';
const server = new OSCQueryServer({ serviceName: 'Avatar-of-a-test', oscQueryHostName: 'Avatar-of-a-test', bindAddress: '127.0.0.1', httpPort: 9123, oscPort: 9871, oscIp: '127.0.0.1', oscTransport: 'UDP' });
server.addMethod('/avatar/parameters/pat_left', { access: 2, arguments: [{ type: 'f' }] });
await server.start();
CODE
vest=
node server.mjs &
server=$!
sleep 2
/usr/bin/python3 "$root/Standalone/Examples/vest.py" pat_left=0,0 pat_right=2,0 --from 9872 --find avatar --interface 127.0.0.1 2>said &
vest=$!
/usr/bin/python3 - <<'CODE'
import socket, struct, time
heard, told = (socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2))
heard.bind(("127.0.0.1", 9871))
heard.settimeout(0.5)
text = lambda word: word.encode() + bytes(4 - len(word) % 4)
hit = text("/physvib/hit") + text(",sfsfsfsf") + b"".join(text(name) + struct.pack(">f", value) for name, value in (("decay_per_s", 3), ("amplitude", 0.5), ("x_m", 0), ("y_m", 0)))
for _ in range(40):
    told.sendto(hit, ("127.0.0.1", 9872))
    try:
        packet = heard.recv(999)
    except TimeoutError:
        continue
    value = struct.unpack(">f", packet[-4:])[0]
    assert packet.startswith(b"/avatar/parameters/pat_left\0") and 0.3 < value <= 1, packet
    print(f"oscquery: found, and pat_left gets {value:.2f}")
    break
else:
    raise SystemExit("oscquery: nothing came")
CODE
grep -q "vest: Avatar-of-a-test has no pat_right" said || { cat said; exit 1; }
kill $vest
wait $vest || :
vest=
! timeout 20 /usr/bin/python3 "$root/Standalone/Examples/vest.py" a=0,0 --find nobody --interface 127.0.0.1 2>said
grep -q "expected a program with nobody in its name" said
