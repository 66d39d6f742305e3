/* SPDX-License-Identifier: MIT
 * Preloaded into a program, it lists one serial port alone, PHYSVIB_BOARD_PORT, as a four-channel board is
 * listed that hangs at USB. */
#include <libserialport.h>
#include <stdlib.h>

static struct sp_port* ports[2];

enum sp_return sp_list_ports(struct sp_port*** list) {
    ports[0] = (struct sp_port*)(void*)ports; /* never looked into */
    *list = ports;
    return SP_OK;
}

void sp_free_port_list(struct sp_port** list) { (void)list; }

char* sp_get_port_name(const struct sp_port* port) {
    (void)port;
    return getenv("PHYSVIB_BOARD_PORT");
}

char* sp_get_port_description(const struct sp_port* port) {
    (void)port;
    return (char*)"a virtual board";
}

enum sp_return sp_get_port_usb_vid_pid(const struct sp_port* port, int* vendor, int* product) {
    (void)port;
    *vendor = 0x0483; /* ST-LINK */
    *product = 0x374b;
    return SP_OK;
}
