// Style sheets are bundled beside the page by build.mjs.
declare module "*.css";
