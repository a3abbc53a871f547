import "./page.css";
import "./studio.ts";
