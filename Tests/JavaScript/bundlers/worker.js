// SPDX-License-Identifier: MIT
// The same samples in a worker.
onmessage = async ({ data }) => {
    try {
        const physvib = await load(), channels = physvib.render(data, { seconds: 0.2, layout: 'phone4' });
        postMessage(channels.reduce((sum, channel) => channel.reduce((hash, sample) => (hash * 31 + Math.round(sample * 1e9)) | 0, sum), 0));
    } catch (error) { postMessage(String(error.message)); }
};
