import * as fiber from '@react-three/fiber';
import * as react from 'react';
import * as jsx from 'react/jsx-runtime';
import * as client from 'react-dom/client';
import * as vexture from 'vexture';
import * as components from 'vexture/react';

Object.assign(globalThis.galleryModules, {
  vexture, react, '@react-three/fiber': fiber, 'react-dom/client': client, 'react/jsx-runtime': jsx, 'vexture/react': components,
});
