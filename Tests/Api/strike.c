/* SPDX-License-Identifier: MIT */
/* One impact on a device, then the end: ./strike [DEVICE]. `physvib devices` lists devices. Linux. */
#include <physvib/physvib-live.h>
#include <stdio.h>
#include <unistd.h>

static int failed(const char* what) {
    fprintf(stderr, "%s: %s\n", what, physvib_live_error());
    return 1;
}

int main(int count, char** words) {
    physvib_renderer_settings settings; /* four actuators, on the corners of a phone */
    physvib_live_status status;
    physvib_live live;

    physvib_renderer_settings_init(&settings, sizeof settings);
    settings.field_width_m = settings.field_height_m = 1.0;
    if (physvib_live_open(count > 1 ? words[1] : "JACK:system", &settings, NULL, &live) != PHYSVIB_OK)
        return failed("open");

    sleep(1); /* the device starts with a ramp */
    if (physvib_live_impact_of(live, "wooden board", 0.3, 0.5, 0.5) != PHYSVIB_OK) return failed("impact");

    sleep(1); /* it leaves L after its time, and rings; physvib_live_close would cut it off */
    physvib_live_status_init(&status, sizeof status);
    physvib_live_get_status(live, &status);
    printf("%d played, felt %.1f ms after its time\n", (int)status.played,
           (double)physvib_live_latency_ns(live) * 1e-6);
    return physvib_live_close(live) == PHYSVIB_OK && status.played == 1 ? 0 : failed("close");
}
