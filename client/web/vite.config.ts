import {defineConfig} from 'vitest/config';

// `npm run dev` serves the sources and passes calls on to the gateway of this address.
const gateway = process.env.CONTACT_HTTP ?? 'http://127.0.0.1:8080';

export default defineConfig({
  esbuild: {jsx: 'automatic', jsxImportSource: 'preact'},
  build: {
    target: 'es2022',
    assetsInlineLimit: 0,          // The content security policy allows files, not data.
    modulePreload: {polyfill: false},
  },
  server: {proxy: {'/contact.v1': gateway, '/metrics': gateway}, fs: {allow: ['../..']}},
  test: {include: ['test/**/*.test.ts']},
});
