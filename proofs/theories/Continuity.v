(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Scott continuity of the partial triangulation T: the region of the possible edges at the limit is the intersection
   of the regions at the stages. (That of V is int_limit and ext_limit.) *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Disc PartialDisc Crossing Path Bounds Limits Compact.
Open Scope R_scope.

(* How far z is outside of the rectangle of all points mix t x y, on each of its four sides. *)
Definition beyond (X Y : rect) (z : point) (t : R) (m : R) : Prop :=
  m < (1 - t) * xlo X + t * xlo Y - fst z \/ m < fst z - ((1 - t) * xhi X + t * xhi Y) \/
  m < (1 - t) * ylo X + t * ylo Y - snd z \/ m < snd z - ((1 - t) * yhi X + t * yhi Y).

Lemma split_between t a b c d z : a <= b -> c <= d -> (1 - t) * a + t * c <= z <= (1 - t) * b + t * d ->
  exists x y, a <= x <= b /\ c <= y <= d /\ z = (1 - t) * x + t * y.
Proof.
  intros H G Z. set (lo := (1 - t) * a + t * c) in *. set (hi := (1 - t) * b + t * d) in *.
  destruct (Req_dec lo hi) as [E | E].
  - exists a, c. fold lo. lra.
  - set (s := (z - lo) / (hi - lo)). assert (0 < / (hi - lo)) by (apply Rinv_0_lt_compat; lra).
    assert (S : 0 <= s <= 1).
    { unfold s. split; [apply Rmult_le_pos; lra |]. apply (Rmult_le_reg_r (hi - lo)); [lra |].
      unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
    exists (a + s * (b - a)), (c + s * (d - c)). split; [nra |]. split; [nra |].
    transitivity (lo + s * (hi - lo)); [unfold s; field; lra | unfold lo, hi; ring].
Qed.

Lemma not_beyond X Y z t : ~ beyond X Y z t 0 -> exists x y, inside x X /\ inside y Y /\ z = mix t x y.
Proof.
  intros H. unfold beyond in H.
  destruct (split_between t (xlo X) (xhi X) (xlo Y) (xhi Y) (fst z)) as [x [y [Hx [Hy E]]]];
    [apply x_ordered | apply x_ordered | split; apply Rnot_lt_le; intros C; apply H; lra |].
  destruct (split_between t (ylo X) (yhi X) (ylo Y) (yhi Y) (snd z)) as [u [v [Hu [Hv F]]]];
    [apply y_ordered | apply y_ordered | split; apply Rnot_lt_le; intros C; apply H; lra |].
  exists (x, u), (y, v). split; [now split |]. split; [now split |]. destruct z. unfold mix. simpl in *. now rewrite E, F.
Qed.

(* A point outside Ed(X,Y) is outside Ed of rectangles near X and Y. *)
Lemma outside_persists X Y z : ~ partial_edge X Y z ->
  exists e, 0 < e /\ forall X' Y', close e X' X -> close e Y' Y -> ~ partial_edge X' Y' z.
Proof.
  intros H. destruct (uniform (fun t e => beyond X Y z t e) 0 1) as [e [E G]].
  - intros s d e D K. unfold beyond in *. lra.
  - intros t T.
    assert (K : beyond X Y z t 0).
    { apply NNPP. intros C. apply H. destruct (not_beyond X Y z t C) as [x [y [Ix [Iy Z]]]].
      exists x, y. split; [exact Ix |]. split; [exact Iy |]. now exists t. }
    assert (M : forall f, continuity f -> 0 < f t -> exists e, 0 < e /\ forall s, Rabs (s - t) <= e -> e < f s).
    { intros f Cf Pf. destruct (near_positive (fun s => f s - f t / 2) t) as [e [E F]].
      - apply (continuity_minus f (fun _ => f t / 2)); [exact Cf | apply continuity_const; now intros ? ?].
      - lra.
      - exists (Rmin e (f t / 2)). pose proof (Rmin_l e (f t / 2)). pose proof (Rmin_r e (f t / 2)).
        split; [apply Rmin_pos; lra |]. intros s S. specialize (F s ltac:(lra)). simpl in F. lra. }
    destruct K as [K | [K | [K | K]]].
    + destruct (M (fun s => (1 - s) * xlo X + s * xlo Y - fst z)) as [e [E F]]; [reg | exact K |].
      exists e. split; [exact E |]. intros s S. left. now apply F.
    + destruct (M (fun s => fst z - ((1 - s) * xhi X + s * xhi Y))) as [e [E F]]; [reg | exact K |].
      exists e. split; [exact E |]. intros s S. right. left. now apply F.
    + destruct (M (fun s => (1 - s) * ylo X + s * ylo Y - snd z)) as [e [E F]]; [reg | exact K |].
      exists e. split; [exact E |]. intros s S. right. right. left. now apply F.
    + destruct (M (fun s => snd z - ((1 - s) * yhi X + s * yhi Y))) as [e [E F]]; [reg | exact K |].
      exists e. split; [exact E |]. intros s S. right. right. right. now apply F.
  - exists e. split; [exact E |]. intros X' Y' [A1 [A2 [A3 A4]]] [B1 [B2 [B3 B4]]] [x [y [[Xx Xy] [[Yx Yy] [t [T Z]]]]]].
    apply abs_le in A1, A2, A3, A4, B1, B2, B3, B4. specialize (G t T). rewrite Z in G.
    unfold beyond, mix in G. simpl in G.
    assert (W : forall u v u' v', u - e <= u' -> v - e <= v' -> (1 - t) * u + t * v - e <= (1 - t) * u' + t * v').
    { intros u v u' v' U V. assert ((1 - t) * (u - e) <= (1 - t) * u') by (apply Rmult_le_compat_l; lra).
      assert (t * (v - e) <= t * v') by (apply Rmult_le_compat_l; lra). lra. }
    pose proof (W (xlo X) (xlo Y) (fst x) (fst y)). pose proof (W (ylo X) (ylo Y) (snd x) (snd y)).
    pose proof (W (- xhi X) (- xhi Y) (- fst x) (- fst y)). pose proof (W (- yhi X) (- yhi Y) (- snd x) (- snd y)). lra.
Qed.

Theorem region_limit N B L z : limit N B L ->
  (possible_region N L z <-> forall n, possible_region N (B n) z).
Proof.
  intros K. split.
  - intros [i [j [I [J [D [P Z]]]]]] n. exists i, j. repeat split; try assumption.
    + now apply (possible_limit N B L i j K I J).
    + destruct Z as [x [y [X [Y Z]]]]. exists x, y.
      split; [now apply (limit_refines N B L n K i I) |]. split; [now apply (limit_refines N B L n K j J) | exact Z].
  - intros H. apply NNPP. intros C.
    destruct (late_finite (fun i n => forall j, (j < N)%nat -> i <> j ->
      ~ (possible N (B n) i j /\ partial_edge (B n i) (B n j) z)) N) as [n A].
    { intros i I. apply (late_finite (fun j n => i <> j ->
        ~ (possible N (B n) i j /\ partial_edge (B n i) (B n j) z)) N).
      intros j J. destruct (classic (possible N L i j /\ i <> j)) as [[P D] | P].
      - destruct (outside_persists (L i) (L j) z) as [e [E G]].
        { intros Z. apply C. now exists i, j. }
        destruct K as [_ K]. destruct (late_and _ _ (K i e I E) (K j e J E)) as [n A].
        exists n. intros m M _ [_ Z]. destruct (A m M) as [A1 A2]. now apply (G (B m i) (B m j)).
      - destruct (classic (i = j)) as [-> | D]; [exists 0%nat; now intros |].
        assert (X : exists n, ~ possible N (B n) i j).
        { apply NNPP. intros Y. apply P. split; [| exact D]. apply (possible_limit N B L i j K I J). intros n.
          apply NNPP. intros Z. apply Y. now exists n. }
        destruct X as [n X]. exists n. intros m M _ [Y _]. apply X.
        apply (possible_monotone N (B m) (B n)); [exact I | exact J | | exact Y].
        destruct K as [K _]. now apply later_refines. }
    destruct (H n) as [i [j [I [J [D [P Z]]]]]]. apply (A n (le_n n) i I j J D). now split.
Qed.
