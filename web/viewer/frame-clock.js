/** Frame times from the first command until the GPU has finished, without blocking. */

const PATIENCE = 2000; // ms

export class FrameClock {
  #waiting = false;

  /**
   * @param {import('three').WebGLRenderer} renderer
   * @param {number} begin start of the frame
   * @param {(milliseconds: number) => void} done
   */
  measure(renderer, begin, done) {
    const gl = /** @type {WebGL2RenderingContext} */ (renderer.getContext());
    if (this.#waiting || gl.isContextLost()) return done(performance.now() - begin);
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (!fence) return done(performance.now() - begin);
    gl.flush();
    this.#waiting = true;
    const channel = new MessageChannel(); // timers are too coarse: at least 4 ms
    channel.port1.onmessage = () => {
      const now = performance.now();
      const state = gl.isContextLost() ? gl.ALREADY_SIGNALED : gl.clientWaitSync(fence, 0, 0);
      if (state === gl.TIMEOUT_EXPIRED && now - begin < PATIENCE) return void channel.port2.postMessage(0);
      this.#waiting = false;
      channel.port1.close();
      gl.deleteSync(fence);
      done(now - begin);
    };
    channel.port2.postMessage(0);
  }
}
