// A page opened with file:// cannot load modules or models; say so instead of staying blank.
// A classic script, because modules are exactly what does not run there.
if (location.protocol === "file:") {
  document.documentElement.dataset.veduta = "error";
  document.body.innerHTML =
    '<main style="max-width:34rem;margin:18vh auto;padding:0 1.5rem;font:16px/1.6 system-ui,sans-serif">' +
    "<h1>This folder needs a web server</h1>" +
    "<p>A browser does not let a page that was opened from the disk read the model beside it.</p>" +
    "<p>Open a terminal in this folder, type <code>python3 -m http.server</code>, " +
    "and visit <code>http://localhost:8000</code>.</p></main>";
}
