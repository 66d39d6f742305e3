#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Serves the page by https, so that a phone in the same network gets its sound and its sensors: serve.py [--port 8443] [FOLDER (its own, or build/web/page)]
The certificate is made at the start, and signed by nobody: the browser warns of it once, as it does of every such one. Needs openssl."""
import argparse
import functools
import http.server
import os
import pathlib
import socket
import ssl
import subprocess
import sys
import tempfile

OWN = pathlib.Path(__file__).resolve().parent
options = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
options.add_argument("--port", type=int, default=8443)
options.add_argument("--with-parent", action="store_true", help="ends with the program that began it")
options.add_argument("folder", nargs="?", type=pathlib.Path, default=OWN if (OWN / "index.html").is_file() else OWN.parents[1] / "build/web/page")
given = options.parse_args()
if not (given.folder / "index.html").is_file():
    sys.exit(f"serve.py: {given.folder}: expected the page; Standalone/Web/build-web.sh builds it")


def own_address():
    """The address that this computer has in its network; nothing is sent."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))  # an address that is nobody's
            return probe.getsockname()[0]
        except OSError:
            return "127.0.0.1"


class Handler(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".wasm": "application/wasm", ".webmanifest": "application/manifest+json", ".js": "text/javascript"}

    def log_message(self, *words):
        pass


class Server(http.server.ThreadingHTTPServer):
    def service_actions(self):  # twice a second
        if given.with_parent and os.getppid() != parent:
            os._exit(0)

    def handle_error(self, request, client_address):
        pass  # browsers hang up while they ask about the certificate


address, parent = own_address(), os.getppid()
context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
with tempfile.TemporaryDirectory() as folder:
    try:
        subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "30", "-subj", f"/CN={address}", "-addext", f"subjectAltName=IP:{address},IP:127.0.0.1,DNS:localhost",
                        "-keyout", f"{folder}/key.pem", "-out", f"{folder}/certificate.pem"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    except (OSError, subprocess.CalledProcessError):
        sys.exit("serve.py: openssl: expected the program of this name (Debian: apt-get install openssl)")
    context.load_cert_chain(f"{folder}/certificate.pem", f"{folder}/key.pem")
server = Server(("", given.port), functools.partial(Handler, directory=given.folder))
server.socket = context.wrap_socket(server.socket, server_side=True, do_handshake_on_connect=False)
print(f"https://{address}:{given.port}  (the browser warns of the certificate, which this computer has signed itself; Ctrl+C ends it)", flush=True)
try:
    server.serve_forever()
except KeyboardInterrupt:
    pass
