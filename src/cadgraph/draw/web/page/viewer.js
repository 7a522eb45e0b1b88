const element = document.getElementById("cadgraph-data-content");
if (element) {
  const bytes = Uint8Array.from(atob(element.textContent), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  const content = JSON.parse(await new Response(stream).text());
  document.title = content.title;
  document.getElementById("plant").textContent = `${content.title}: ${content.parts.id.length} parts`;
}
