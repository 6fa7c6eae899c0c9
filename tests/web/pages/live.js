// A page that follows a shape and writes down what it is told. Its address says where and how.
import { LiveVectorTexture } from 'vexture';

const options = new URLSearchParams(location.search);
window.events = [];
window.follow = () => LiveVectorTexture.connect(options.get('manifest'), { interval: Number(options.get('interval')) });
window.live = window.follow().then(
  (texture) => {
    for (const type of ['change', 'note', 'offline', 'online']) {
      texture.addEventListener(type, ({ message }) => window.events.push(message ? `${type}: ${message}` : type));
    }
    window.texture = texture;
    return texture.name;
  },
);
