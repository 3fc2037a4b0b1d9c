(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The reach of a site: where only sites 0 .. M-1 are seen, a chain of points and directions about the possible cell of
   site i among them gives discs and half-planes such that sites that meet none of them change neither the possible
   pairs of i, nor that a pair of exact points is legal [REACH-1]. *)
From Coq Require Import Reals Lra Lia Psatz ZArith List Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Winding.
Open Scope R_scope.

(* ---- a closed polygon winds around points of its convex hull only ---- *)

Definition vertex (E : list (nat * nat)) (v : nat) : Prop := exists w, In (v, w) E \/ In (w, v) E.
Inductive hull (E : list (nat * nat)) (p : nat -> point) : point -> Prop :=
| hull_at v : vertex E v -> hull E p (p v)
| hull_mix t x y : 0 <= t <= 1 -> hull E p x -> hull E p y -> hull E p (mix t x y).

Lemma hull_side E p a b t : In (a, b) E -> 0 <= t <= 1 -> hull E p (mix t (p a) (p b)).
Proof. intros F T. apply hull_mix; [exact T | |]; apply hull_at; [exists b; now left | exists a; now right]. Qed.

(* An affine function that is not positive at a point of the hull is not positive at a corner. *)
Lemma hull_affine E p (g : point -> R) z : (forall t x y, g (mix t x y) = (1 - t) * g x + t * g y) ->
  hull E p z -> g z <= 0 -> exists v, vertex E v /\ g (p v) <= 0.
Proof.
  intros A H. induction H as [v V | t x y T Hx IHx Hy IHy]; intros G; [now exists v |].
  destruct (Rle_dec (g x) 0) as [X | X]; [now apply IHx |]. destruct (Rle_dec (g y) 0) as [Y | Y]; [now apply IHy |].
  exfalso. rewrite A in G. assert (0 <= (1 - t) * g x) by (apply Rmult_le_pos; lra).
  destruct (Req_dec t 0) as [Z | Z]; [subst; lra |].
  assert (0 < t * g y) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

(* The point of a side straight above or below z. *)
Lemma side_point a b z : fst a < fst z <= fst b \/ fst b < fst z <= fst a ->
  exists s, 0 <= s <= 1 /\ fst (mix s a b) = fst z /\ orient a b z = (fst b - fst a) * (snd z - snd (mix s a b)).
Proof.
  intros H. assert (D : fst b - fst a <> 0) by (destruct H; lra).
  set (s := (fst z - fst a) / (fst b - fst a)).
  assert (S : s * (fst b - fst a) = fst z - fst a) by (unfold s; field; exact D).
  exists s. split; [| split].
  - split; apply Rnot_lt_le; intros L; destruct H as [H | H]; nra.
  - unfold mix. simpl. lra.
  - unfold orient, mix. simpl. rewrite <- S. ring.
Qed.

Lemma vertical l h z : fst l = fst z -> fst h = fst z -> snd l <= snd z < snd h -> between z l h.
Proof.
  intros L H S. set (t := (snd z - snd l) / (snd h - snd l)).
  assert (T : t * (snd h - snd l) = snd z - snd l) by (unfold t; field; lra).
  exists t. split.
  - split; apply Rnot_lt_le; intros N; nra.
  - destruct z as [x y]. unfold mix. simpl in *. rewrite L, H. f_equal; lra.
Qed.

Lemma total_none c E : (forall a b, In (a, b) E -> c a b = 0%Z) -> total c E = 0%Z.
Proof.
  unfold total. induction E as [| [a b] E IH]; intros H; simpl; [reflexivity |].
  rewrite IH by (intros x y X; apply H; now right). rewrite (H a b); [reflexivity | now left].
Qed.

Theorem winds_in_hull E p z : closed E -> total (fun a b => passes z (p a) (p b)) E <> 0%Z -> hull E p z.
Proof.
  intros C W.
  assert (Up : exists h, hull E p h /\ fst h = fst z /\ snd z < snd h).
  { apply NNPP. intros No. apply W, total_none. intros a b F. unfold passes.
    destruct (right_cases z (p a)) as [[-> A] | [-> A]]; destruct (right_cases z (p b)) as [[-> D] | [-> D]];
      try reflexivity.
    - destruct (Rlt_dec 0 (orient (p a) (p b) z)) as [L | L]; [exfalso | reflexivity].
      destruct (side_point (p a) (p b) z) as [s [S [X O]]]; [right; lra |].
      apply No. exists (mix s (p a) (p b)). split; [now apply hull_side |]. split; [exact X |]. nra.
    - destruct (Rlt_dec (orient (p a) (p b) z) 0) as [L | L]; [exfalso | reflexivity].
      destruct (side_point (p a) (p b) z) as [s [S [X O]]]; [left; lra |].
      apply No. exists (mix s (p a) (p b)). split; [now apply hull_side |]. split; [exact X |]. nra. }
  assert (Low : exists l, hull E p l /\ fst l = fst z /\ snd l <= snd z).
  { apply NNPP. intros No. apply W.
    rewrite (total_same _ (fun a b => (right z (p b) - right z (p a))%Z)); [apply (C (fun v => right z (p v))) |].
    intros a b F. apply passes_above; intros H; apply Rnot_le_lt; intros L.
    - destruct (side_point (p a) (p b) z) as [s [S [X O]]]; [now left |].
      apply No. exists (mix s (p a) (p b)). split; [now apply hull_side |]. split; [exact X |]. nra.
    - destruct (side_point (p a) (p b) z) as [s [S [X O]]]; [now right |].
      apply No. exists (mix s (p a) (p b)). split; [now apply hull_side |]. split; [exact X |]. nra. }
  destruct Up as [h [Hh [Xh Yh]]], Low as [l [Hl [Xl Yl]]].
  destruct (vertical l h z Xl Xh (conj Yl Yh)) as [t [T ->]]. now apply hull_mix.
Qed.

(* ---- properties that hold from some number on ---- *)

Lemma late_list {A} (P : A -> R -> Prop) l : (forall e, In e l -> exists T, forall t, T < t -> P e t) ->
  exists T, forall t, T < t -> forall e, In e l -> P e t.
Proof.
  induction l as [| y l IH]; intros H.
  - exists 0. intros t _ e [].
  - destruct (H y (or_introl eq_refl)) as [T Ht]. destruct IH as [U Hu]; [intros e F; apply H; now right |].
    exists (Rmax T U). intros t L e [<- | F]; pose proof (Rmax_l T U); pose proof (Rmax_r T U);
      [apply Ht | apply Hu]; try exact F; lra.
Qed.

(* For corners, when it holds for all of them one by one. *)
Lemma late_vertex E (P : nat -> R -> Prop) : (forall v, vertex E v -> exists T, forall t, T < t -> P v t) ->
  exists T, forall t, T < t -> forall v, vertex E v -> P v t.
Proof.
  intros H. destruct (late_list (fun e t => P (fst e) t /\ P (snd e) t) E) as [T L].
  - intros [a b] F. destruct (H a) as [T A]; [exists b; now left |]. destruct (H b) as [U D]; [exists a; now right |].
    exists (Rmax T U). intros t Lt. pose proof (Rmax_l T U). pose proof (Rmax_r T U).
    split; simpl; [apply A | apply D]; lra.
  - exists T. intros t Lt v [w [F | F]]; [apply (L t Lt (v, w) F) | apply (L t Lt (w, v) F)].
Qed.

(* A line that rises gets above 0. *)
Lemma late_positive m n : 0 < n -> exists T, forall t, T < t -> 0 < m + t * n.
Proof.
  intros N. exists (- m / n). intros t L. apply (Rmult_lt_compat_r n) in L; [| exact N].
  unfold Rdiv in L. rewrite Rmult_assoc, Rinv_l in L; lra.
Qed.

(* ---- chains ---- *)

Inductive knot : Type := At (c : point) | Far (u : point).
Definition turn (a b : point) : R := fst a * snd b - snd a * fst b.
Definition ahead_by (c u : point) (t : R) : point := (fst c + t * fst u, snd c + t * snd u).

Section Chain.
Variables (M : nat) (B : sites) (i : nat) (o : point) (E : list (nat * nat)) (q : nat -> knot).

Definition in_region (k : nat) (e : knot) : Prop :=
  match e with
  | At c => dl c (B k) < ds c (B i)
  | Far u => dot u (highest u (B i)) < dot u (lowest u (B k))
  end.
Definition seen_from (e : knot) : point :=
  match e with At c => (fst c - fst o, snd c - snd o) | Far u => u end.

(* Seen from the point o of R_i all turns are to the left; a side is bounded by a seen site, or a gap. *)
Definition chain : Prop := inside o (B i) /\ closed E /\ E <> nil /\
  forall a b, In (a, b) E -> 0 < turn (seen_from (q a)) (seen_from (q b)) /\
    ((exists k, (k < M)%nat /\ in_region k (q a) /\ in_region k (q b)) \/ exists u w, q a = Far u /\ q b = Far w).

(* j = i: the reach of i; the wide one has those of some j, too. *)
Definition in_reach (j : nat) (x : point) : Prop := exists v, vertex E v /\
  match q v with At c => dist c x <= dl c (B j) | Far u => dot u (lowest u (B j)) <= dot u x end.

(* The polygon at the time t: directions are points far away. *)
Definition place (t : R) (v : nat) : point := match q v with At c => c | Far u => ahead_by o u t end.

Variable is_chain : chain.

Lemma region_late k a : in_region k (q a) -> exists T, forall t, T < t -> dl (place t a) (B k) < ds (place t a) (B i).
Proof.
  unfold in_region, place. destruct (q a) as [c | u]; intros H; [now exists 0 |].
  destruct (far_nearer o u (B k) (B i) (dot u (lowest u (B k)) - dot u (highest u (B i)))) as [T [_ L]]; [lra | lra |].
  exists T. exact L.
Qed.

(* From c by way of the nearest point of R_i to o. *)
Definition on_way (c z : point) : Prop := between z c (nearest c (B i)) \/ between z (nearest c (B i)) o.

Lemma way_possible c z : pos M B i c -> on_way c z -> pos M B i z.
Proof.
  intros P [[t [T ->]] | [t [T ->]]]; [now apply pos_star |]. intros k _.
  assert (I : inside (mix t (nearest c (B i)) o) (B i)).
  { apply inside_convex; [exact T | apply nearest_inside | apply is_chain]. }
  pose proof (ds_le (mix t (nearest c (B i)) o) _ _ I) as D. rewrite dist_self in D.
  pose proof (dl_nonneg (mix t (nearest c (B i)) o) (B k)). lra.
Qed.

Lemma gap_leaves c u w : 0 < turn u w -> exists T, forall t, T < t ->
  forall z, on_way c z -> ~ between z (ahead_by o u t) (ahead_by o w t).
Proof.
  intros D. set (g := fun z : point => (snd w - snd u) * (fst z - fst o) - (fst w - fst u) * (snd z - snd o)).
  set (x := nearest c (B i)).
  destruct (late_positive (- (Rabs (g c) + Rabs (g x))) (turn u w) D) as [T L]. exists T. intros t Lt z W [s [S Z]].
  specialize (L t Lt).
  assert (G : g z = t * turn u w) by (rewrite Z; unfold g, mix, ahead_by, turn; simpl; ring).
  pose proof (Rle_abs (g c)). pose proof (Rle_abs (g x)). pose proof (Rabs_pos (g c)). pose proof (Rabs_pos (g x)).
  assert (g z <= Rabs (g c) + Rabs (g x)); [| lra].
  destruct W as [[r [Hr Q]] | [r [Hr Q]]].
  - fold x in Q. assert (A : g z = (1 - r) * g c + r * g x) by (rewrite Q; unfold g, mix; simpl; ring). nra.
  - fold x in Q. assert (A : g z = (1 - r) * g x) by (rewrite Q; unfold g, mix; simpl; ring). nra.
Qed.

Lemma side_off c a b : pos M B i c -> In (a, b) E -> exists T, forall t, T < t ->
  forall z, on_way c z -> ~ between z (place t a) (place t b).
Proof.
  intros P F. destruct is_chain as [_ [_ [_ H]]]. destruct (H a b F) as [D [[k [K [A C]]] | [u [w [A C]]]]].
  - destruct (region_late k a A) as [T Ha]. destruct (region_late k b C) as [U Hb]. exists (Rmax T U).
    intros t L z W [s [S Z]]. pose proof (Rmax_l T U). pose proof (Rmax_r T U).
    pose proof (way_possible c z P W k K).
    pose proof (closer_rect_convex (place t a) (place t b) s (B k) (B i) S (Ha t ltac:(lra)) (Hb t ltac:(lra))) as Q.
    rewrite <- Z in Q. lra.
  - rewrite A, C in D. simpl in D. destruct (gap_leaves c u w D) as [T L]. exists T. intros t Lt z W.
    unfold place. rewrite A, C. now apply L.
Qed.

Lemma polygon_turns t a b : 0 < t -> In (a, b) E -> 0 < orient (place t a) (place t b) o.
Proof.
  intros T F. destruct is_chain as [_ [_ [_ H]]]. destruct (H a b F) as [D _]. revert D. unfold place, turn, seen_from.
  destruct (q a) as [c | u], (q b) as [d | w]; unfold orient, ahead_by; simpl; intros D.
  - lra.
  - replace (_ - _) with (t * ((fst c - fst o) * snd w - (snd c - snd o) * fst w)) by ring. now apply Rmult_lt_0_compat.
  - replace (_ - _) with (t * (fst u * (snd d - snd o) - snd u * (fst d - fst o))) by ring. now apply Rmult_lt_0_compat.
  - replace (_ - _) with (t * (t * (fst u * snd w - snd u * fst w))) by ring.
    apply Rmult_lt_0_compat; [exact T | now apply Rmult_lt_0_compat].
Qed.

Lemma steady t c d : closed E -> (forall z, between z c d -> forall a b, In (a, b) E -> ~ between z (place t a) (place t b)) ->
  total (fun a b => passes d (place t a) (place t b)) E = total (fun a b => passes c (place t a) (place t b)) E.
Proof.
  intros C Off. pose proof (winding_steady E (fun v _ => place t v) (fun s => mix s c d) C) as W. simpl in W.
  rewrite mix_0, mix_1 in W. apply W.
  - intros v. split; apply continuity_const; unfold constant; reflexivity.
  - unfold mix. simpl. split; reg.
  - intros s a b S F. apply Off; [now exists s | exact F].
Qed.

(* The possible cell is in the convex hull of the polygon from some time on. *)
Theorem cell_in_hull c : pos M B i c -> exists T, forall t, T < t -> hull E (place t) c.
Proof.
  intros P. destruct is_chain as [_ [C [Ne _]]].
  destruct (late_list (fun e t => forall z, on_way c z -> ~ between z (place t (fst e)) (place t (snd e))) E) as [T L].
  { intros [a b] F. now apply side_off. }
  exists (Rmax T 0). intros t Lt. pose proof (Rmax_l T 0). pose proof (Rmax_r T 0).
  assert (Off : forall z, on_way c z -> forall a b, In (a, b) E -> ~ between z (place t a) (place t b)).
  { intros z W a b F. exact (L t ltac:(lra) (a, b) F z W). }
  apply winds_in_hull; [exact C |]. intros Z. apply Ne.
  apply (winds_around E (place t) o C); [intros a b F; apply polygon_turns; [lra | exact F] |].
  rewrite (steady t (nearest c (B i)) o C), (steady t c (nearest c (B i)) C); [exact Z | |];
    intros z W; apply Off; [now left | now right].
Qed.

(* A place as near to a centre of the possible cell as some point s is as near to a point of the chain, or as far into a
   direction of it. *)
Theorem chain_holds c s x : pos M B i c -> dist c x <= dist c s ->
  exists v, vertex E v /\ match q v with At d => dist d x <= dist d s | Far u => dot u s <= dot u x end.
Proof.
  intros P X. apply NNPP. intros No. set (g := fun z => dist2 z x - dist2 z s).
  assert (Gc : g c <= 0) by (unfold g; apply dist_le in X; lra).
  destruct (late_vertex E (fun v t => 0 < g (place t v))) as [T L].
  { intros v V. unfold place. destruct (q v) as [d | u] eqn:Q.
    - exists 0. intros t _. assert (K : dist d s < dist d x).
      { apply Rnot_le_lt. intros K. apply No. exists v. split; [exact V | now rewrite Q]. }
      apply dist_lt in K. unfold g. lra.
    - assert (K : dot u x < dot u s).
      { apply Rnot_le_lt. intros K. apply No. exists v. split; [exact V | now rewrite Q]. }
      destruct (late_positive (g o) (2 * (dot u s - dot u x))) as [T L]; [lra |]. exists T. intros t Lt.
      specialize (L t Lt).
      replace (g (ahead_by o u t)) with (g o + t * (2 * (dot u s - dot u x)))
        by (unfold g, ahead_by, dist2, dot; simpl; ring). exact L. }
  destruct (cell_in_hull c P) as [U H]. set (t := Rmax T U + 1).
  assert (Lt : T < t /\ U < t) by (unfold t; pose proof (Rmax_l T U); pose proof (Rmax_r T U); lra).
  destruct (hull_affine E (place t) g c) as [v [V G]]; [| apply H; lra | exact Gc |].
  - intros r a b. unfold g. apply nearer_affine.
  - pose proof (L t (proj1 Lt) v V). lra.
Qed.

Theorem reach_holds j c x : pos M B i c -> dist c x <= dl c (B j) -> in_reach j x.
Proof.
  intros P X. destruct (chain_holds c (farthest c (B j)) x P X) as [v [V H]]. exists v. split; [exact V |].
  destruct (q v) as [d | u].
  - pose proof (le_dl d (B j) _ (farthest_inside c (B j))). lra.
  - destruct (lowest_spec u (B j)) as [_ L]. specialize (L _ (farthest_inside c (B j))). lra.
Qed.

(* Where the possible cell is endless, its direction is between those of the chain. *)
Lemma ray_between c u y : u <> (0, 0) -> (forall t, 0 <= t -> pos M B i (ahead_by c u t)) ->
  (forall v w, vertex E v -> q v = Far w -> dot w y < 0) -> dot u y < 0.
Proof.
  intros U P Y. apply NNPP. intros No.
  assert (Uu : 0 < dot u u).
  { destruct u as [a b]. unfold dot. simpl. destruct (Req_dec a 0) as [A | A]; [destruct (Req_dec b 0) as [D | D] |].
    - exfalso. apply U. now subst.
    - nra.
    - nra. }
  destruct (late_vertex E (fun v r => forall w, q v = Far w -> 0 < - dot w u + r * - dot w y)) as [S Hs].
  { intros v V. destruct (q v) as [d | w] eqn:Q; [exists 0; discriminate |].
    destruct (late_positive (- dot w u) (- dot w y)) as [T L]; [pose proof (Y v w V Q); lra |].
    exists T. intros t Lt w' W. injection W as <-. now apply L. }
  set (r := Rmax S 0 + 1). assert (Lr : S < r /\ 0 < r) by (unfold r; pose proof (Rmax_l S 0); pose proof (Rmax_r S 0); lra).
  specialize (Hs r (proj1 Lr)). set (h := fun z => dot u z + r * dot y z).
  assert (Hu : 0 < h u).
  { unfold h. assert (0 <= r * dot y u) by (apply Rmult_le_pos; [lra | replace (dot y u) with (dot u y)
      by (unfold dot; ring); lra]). lra. }
  destruct (late_vertex E (fun v m => forall t, 0 < t -> h (place t v) < m)) as [T Ht].
  { intros v V. unfold place. destruct (q v) as [d | w] eqn:Q; [exists (h d); intros; lra |].
    exists (h o). intros m Lm t Lt. pose proof (Hs v V w Q).
    replace (h (ahead_by o w t)) with (h o + t * (dot w u + r * dot w y)) by (unfold h, ahead_by, dot; simpl; ring).
    assert (0 <= t * - (dot w u + r * dot w y)) by (apply Rmult_le_pos; lra). lra. }
  set (m := T + 1). specialize (Ht m ltac:(unfold m; lra)).
  destruct (late_positive (h c - m) (h u) Hu) as [W Hw].
  set (n := Rmax W 0 + 1). assert (Ln : W < n /\ 0 < n) by (unfold n; pose proof (Rmax_l W 0); pose proof (Rmax_r W 0); lra).
  specialize (Hw n (proj1 Ln)).
  destruct (cell_in_hull (ahead_by c u n)) as [V Hv]; [apply P; lra |].
  set (t := Rmax V 0 + 1). assert (Lt : V < t /\ 0 < t) by (unfold t; pose proof (Rmax_l V 0); pose proof (Rmax_r V 0); lra).
  destruct (hull_affine E (place t) (fun z => h (ahead_by c u n) - h z) (ahead_by c u n)) as [v [Vv G]].
  - intros s a b. unfold h, dot, mix. simpl. ring.
  - apply Hv. lra.
  - lra.
  - pose proof (Ht v Vv t (proj2 Lt)).
    replace (h (ahead_by c u n)) with (h c + n * h u) in G by (unfold h, ahead_by, dot; simpl; ring). lra.
Qed.

(* ---- sites that are not seen ---- *)

Variable N : nat.
Variable seen_own : (i < M)%nat.
Variable more : (M <= N)%nat.
Variable not_met : forall k x, (M <= k < N)%nat -> inside x (B k) -> ~ in_reach i x.

Lemma unseen_far c k : pos M B i c -> (M <= k < N)%nat -> dl c (B i) < ds c (B k).
Proof.
  intros P K. apply Rnot_le_lt. intros L. apply (not_met k (nearest c (B k)) K (nearest_inside c (B k))).
  now apply (reach_holds i c).
Qed.

Lemma unseen_below u k x : u <> (0, 0) -> (forall l, (l < M)%nat -> dot u (lowest u (B l)) <= dot u (highest u (B i))) ->
  (M <= k < N)%nat -> inside x (B k) -> dot u x < dot u (lowest u (B i)).
Proof.
  intros U H K X. set (s := lowest u (B i)).
  assert (D : dot u (fst x - fst s, snd x - snd s) < 0);
    [| unfold dot in D |- *; clearbody s; simpl in D; lra].
  apply (ray_between (highest u (B i)) u); [exact U | |].
  - intros t T l L. destruct (highest_spec u (B i)) as [I _]. set (e := highest u (B i)) in *.
    pose proof (ds_le (ahead_by e u t) _ _ I). set (y := lowest u (B l)).
    pose proof (le_dl (ahead_by e u t) _ _ (proj1 (lowest_spec u (B l)))) as A. fold y in A.
    assert (Q : dist (ahead_by e u t) e <= dist (ahead_by e u t) y); [| lra].
    apply dist_le.
    assert (G : dist2 (ahead_by e u t) y - dist2 (ahead_by e u t) e = dist2 e y + 2 * (t * (dot u e - dot u y)))
      by (unfold ahead_by, dist2, dot; simpl; ring).
    pose proof (dist2_nonneg e y). pose proof (H l L) as Hl. fold y in Hl.
    assert (0 <= t * (dot u e - dot u y)) by (apply Rmult_le_pos; lra). lra.
  - intros v w V Q. destruct (lowest_spec w (B i)) as [_ Lw]. specialize (Lw s (proj1 (lowest_spec u (B i)))).
    assert (dot w x < dot w (lowest w (B i))).
    { apply Rnot_le_lt. intros L. apply (not_met k x K X). exists v. split; [exact V |]. now rewrite Q. }
    clearbody s. unfold dot in *. simpl. lra.
Qed.

(* The possible pairs of i among all sites are those among the sites seen. *)
Theorem reach_possible j : (j < N)%nat -> (possible N B i j <-> (j < M)%nat /\ possible M B i j).
Proof.
  intros Jn. assert (In : (i < N)%nat) by lia. split.
  - intros [C | [u [U F]]].
    + apply pair_possible in C; [| exact In | exact Jn]. destruct C as [c C].
      pose proof (C i In (or_introl eq_refl)) as Pi. pose proof (C j Jn (or_intror eq_refl)) as Pj.
      assert (Pm : pos M B i c) by (intros k K; apply Pi; lia).
      assert (J : (j < M)%nat).
      { destruct (Nat.lt_ge_cases j M) as [L | L]; [exact L |]. exfalso.
        pose proof (unseen_far c j Pm ltac:(lia)). pose proof (Pj i In). lra. }
      split; [exact J |]. left. apply pair_possible; [exact seen_own | exact J |]. exists c.
      intros m _ [-> | ->] k K; [apply Pi | apply Pj]; lia.
    + assert (J : (j < M)%nat).
      { destruct (Nat.lt_ge_cases j M) as [L | L]; [exact L |]. exfalso.
        pose proof (unseen_below u j (highest u (B j)) U) as D.
        specialize (D ltac:(intros l Ll; apply (F i l In (or_introl eq_refl)); lia) ltac:(lia)
          (proj1 (highest_spec u (B j)))).
        pose proof (F j i Jn (or_intror eq_refl) In). lra. }
      split; [exact J |]. right. exists u. split; [exact U |]. intros a k A S K. apply F; [lia | exact S | lia].
  - intros [J [C | [u [U F]]]].
    + apply pair_possible in C; [| exact seen_own | exact J]. destruct C as [c C].
      pose proof (C i seen_own (or_introl eq_refl)) as Pi. pose proof (C j J (or_intror eq_refl)) as Pj.
      left. apply pair_possible; [exact In | exact Jn |]. exists c. intros m _ S k K.
      destruct (Nat.lt_ge_cases k M) as [L | L]; [destruct S as [-> | ->]; [now apply Pi | now apply Pj] |].
      pose proof (unseen_far c k Pi ltac:(lia)). pose proof (ds_le_dl c (B k)). pose proof (ds_le_dl c (B i)).
      pose proof (Pj i seen_own). destruct S as [-> | ->]; lra.
    + right. exists u. split; [exact U |]. intros m k _ S K.
      destruct (Nat.lt_ge_cases k M) as [L | L]; [apply F; [destruct S as [-> | ->]; assumption | exact S | exact L] |].
      pose proof (unseen_below u k (lowest u (B k)) U) as D.
      specialize (D ltac:(intros l Ll; now apply (F i l seen_own (or_introl eq_refl))) ltac:(lia)
        (proj1 (lowest_spec u (B k)))).
      destruct S as [-> | ->].
      * pose proof (F i i seen_own (or_introl eq_refl) seen_own). lra.
      * pose proof (F j i J (or_intror eq_refl) seen_own). lra.
Qed.

(* A legal pair of exact points among the sites seen is legal among all. *)
Theorem reach_legal j a b : (j < M)%nat -> (forall z, inside z (B i) -> z = a) -> (forall z, inside z (B j) -> z = b) ->
  legal M B i j -> legal N B i j.
Proof.
  intros J A D [c W].
  assert (Li : forall z, dl z (B i) = dist z a /\ ds z (B i) = dist z a).
  { intros z. unfold dl, ds. now rewrite (A _ (farthest_inside z (B i))), (A _ (nearest_inside z (B i))). }
  assert (Lj : forall z, dl z (B j) = dist z b /\ ds z (B j) = dist z b).
  { intros z. unfold dl, ds. now rewrite (D _ (farthest_inside z (B j))), (D _ (nearest_inside z (B j))). }
  assert (Small : exists z, dist z a = dist z b /\
    forall k, (k < M)%nat -> k <> i -> k <> j -> dist z a < ds z (B k)).
  { destruct (Rle_dec (dist c b) (dist c a)) as [L | L].
    - destruct (shrink c a b L) as [t [T [Eq F]]]. exists (mix t c a). split; [exact Eq |]. intros k K Di Dj. rewrite F.
      unfold ds. apply shrunken_misses with (r := dist c a); [exact T | lra |].
      destruct (W k K Di Dj) as [X _]. rewrite (proj1 (Li c)) in X.
      pose proof (ds_le c _ _ (nearest_inside (mix t c a) (B k))). lra.
    - destruct (shrink c b a) as [t [T [Eq F]]]; [lra |]. exists (mix t c b). split; [now symmetry |].
      intros k K Di Dj. rewrite <- Eq, F.
      unfold ds. apply shrunken_misses with (r := dist c b); [exact T | lra |].
      destruct (W k K Di Dj) as [_ X]. rewrite (proj1 (Lj c)) in X.
      pose proof (ds_le c _ _ (nearest_inside (mix t c b) (B k))). lra. }
  destruct Small as [z [Eq H]].
  assert (P : pos M B i z).
  { intros k K. rewrite (proj2 (Li z)). destruct (Nat.eq_dec k i) as [-> | Di]; [rewrite (proj1 (Li z)); lra |].
    destruct (Nat.eq_dec k j) as [-> | Dj]; [rewrite (proj1 (Lj z)); lra |].
    pose proof (H k K Di Dj). pose proof (ds_le_dl z (B k)). lra. }
  exists z. intros k K Di Dj. rewrite (proj1 (Li z)), (proj1 (Lj z)), <- Eq.
  destruct (Nat.lt_ge_cases k M) as [L | L].
  - pose proof (H k L Di Dj). split; lra.
  - pose proof (unseen_far z k P ltac:(lia)) as U. rewrite (proj1 (Li z)) in U. split; lra.
Qed.
End Chain.

(* ---- legal pairs of any rectangles ---- *)

Lemma lipschitz_dl a b X : lipschitz (dist a b) (fun t => dl (mix t a b) X).
Proof. intros s t. pose proof (dl_move (mix s a b) (mix t a b) X) as H. rewrite dist_mix_mix in H. lra. Qed.

Lemma lipschitz_min K f g : lipschitz K f -> lipschitz K g -> lipschitz K (fun t => Rmin (f t) (g t)).
Proof.
  intros F G s t. pose proof (F s t). pose proof (G s t). pose proof (Rmin_l (f s) (g s)). pose proof (Rmin_r (f s) (g s)).
  unfold Rmin at 2. destruct (Rle_dec (f t) (g t)); lra.
Qed.

(* The property of i when no unseen site meets its reach (unseen_far). *)
Definition beyond (M N : nat) (B : sites) (i : nat) : Prop :=
  forall c k, pos M B i c -> (M <= k < N)%nat -> dl c (B i) < ds c (B k).

(* About a witness c, x in the disc: there is a disc within that has x, both ends reach its rim, and no other site seen
   meets it. *)
Lemma nearer_centre M B i j c x r : witness M B i j c -> r = Rmax (dl c (B i)) (dl c (B j)) -> dist c x <= r ->
  exists z, dist z x <= Rmin (dl z (B i)) (dl z (B j)) /\
    forall l, (l < M)%nat -> l <> i -> l <> j -> Rmin (dl z (B i)) (dl z (B j)) < ds z (B l).
Proof.
  intros W Er X. set (m z := Rmin (dl z (B i)) (dl z (B j))).
  assert (Far : forall l, (l < M)%nat -> l <> i -> l <> j -> r < ds c (B l)).
  { intros l L Li Lj. destruct (W l L Li Lj). subst r. now apply Rmax_lub_lt. }
  destruct (Rle_dec (dist c x) (m c)) as [D | D].
  - exists c. split; [exact D |]. intros l L Li Lj. pose proof (Far l L Li Lj).
    pose proof (Rmin_l (dl c (B i)) (dl c (B j))). pose proof (Rmax_l (dl c (B i)) (dl c (B j))). lra.
  - set (f t := m (mix t c x) - (1 - t) * dist c x). destruct (intermediate f) as [t [T E]].
    + apply (lipschitz_continuous (dist c x + dist c x)). apply lipschitz_minus.
      * apply lipschitz_min; apply lipschitz_dl.
      * apply lipschitz_scale, dist_nonneg.
    + unfold f. rewrite mix_0. lra.
    + unfold f, m. pose proof (dl_nonneg (mix 1 c x) (B i)). pose proof (dl_nonneg (mix 1 c x) (B j)).
      pose proof (Rmin_glb _ _ 0 H H0). lra.
    + exists (mix t c x). unfold f in E. fold (m (mix t c x)). split; [rewrite dist_mix_right; lra |].
      intros l L Li Lj. pose proof (Far l L Li Lj). pose proof (ds_move c (mix t c x) (B l)) as Q.
      rewrite dist_mix_left in Q by lra. fold (m (mix t c x)). lra.
Qed.

(* A witness among the sites seen is one among all when no unseen site meets the reaches of both ends. *)
Theorem both_reach_legal M N B i j c : beyond M N B i -> beyond M N B j -> witness M B i j c -> witness N B i j c.
Proof.
  intros Bi Bj W k K Ki Kj. destruct (Nat.lt_ge_cases k M) as [S | S]; [now apply W |].
  set (r := Rmax (dl c (B i)) (dl c (B j))).
  assert (D : r < ds c (B k)); [| pose proof (Rmax_l (dl c (B i)) (dl c (B j)));
    pose proof (Rmax_r (dl c (B i)) (dl c (B j))); unfold r in D; split; lra].
  apply Rnot_le_lt. intros Q.
  destruct (nearer_centre M B i j c (nearest c (B k)) r W eq_refl Q) as [z [X F]].
  pose proof (ds_le z (B k) _ (nearest_inside c (B k))) as Y.
  pose proof (ds_le_dl z (B i)). pose proof (ds_le_dl z (B j)).
  pose proof (Rmin_l (dl z (B i)) (dl z (B j))). pose proof (Rmin_r (dl z (B i)) (dl z (B j))).
  destruct (Rle_dec (dl z (B i)) (dl z (B j))) as [L | L].
  - rewrite Rmin_left in * by lra. pose proof (Bi z k) as U.
    assert (P : pos M B i z); [| specialize (U P ltac:(lia)); lra].
    intros l Hl. pose proof (ds_le_dl z (B l)). destruct (Nat.eq_dec l i) as [-> | Li]; [lra |].
    destruct (Nat.eq_dec l j) as [-> | Lj]; [lra |]. pose proof (F l Hl Li Lj). lra.
  - rewrite Rmin_right in * by lra. pose proof (Bj z k) as U.
    assert (P : pos M B j z); [| specialize (U P ltac:(lia)); lra].
    intros l Hl. pose proof (ds_le_dl z (B l)). destruct (Nat.eq_dec l j) as [-> | Lj]; [lra |].
    destruct (Nat.eq_dec l i) as [-> | Li]; [lra |]. pose proof (F l Hl Li Lj). lra.
Qed.
